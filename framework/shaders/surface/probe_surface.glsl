// SPDX-License-Identifier: MIT
// What `lodestir probe` tells of the surface at a vertex (base/probe.glsl). Nothing where nothing is probed.
#include "base/probe.glsl"
#ifdef PROBING
#include "surface/surface.glsl"

void probeSurface(Surface s) {
    PROBE(position, s.position);
    PROBE(normal, s.normal);
    PROBE(shadingNormal, s.shadingNormal);
    PROBE(uv, s.uv);
    PROBE(barycentrics, s.barycentrics);
    PROBE(instance, s.instance);
    PROBE(primitive, s.primitive);
    PROBE(material, s.material);
}

#define PROBE_SURFACE(s) probeSurface(s)
#else
#define PROBE_SURFACE(s)
#endif
