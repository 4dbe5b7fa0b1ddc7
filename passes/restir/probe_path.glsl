// SPDX-License-Identifier: MIT
// What `lodestir probe` tells of paths: reservoirs, shifts, factors of Jacobians (base/probe.glsl). Nothing where nothing is probed.
#include "base/probe.glsl"
#include "surface/probe_surface.glsl"
#ifdef PROBING
#include "base/random.glsl"
#include "restir/jacobian.glsl"
#include "restir/sample_hit.h"

void probeReservoir(uint place, Reservoir r) {
    probeAppend(place, PROBE_OBJECT, 0u, uvec4(0u));
    PROBE(confidence, confidence(r));
    PROBE(W, r.W);
    if (holdsPath(r)) {
        PathShape s = unpackShape(r.shape);
        PROBE(F, r.F);
        PROBE(target, target(r));
        PROBE(seed, r.seed);
        PROBE(madeForPixel, seedPixel(r.seed, runSeed()));
        PROBE(madeAsSample, r.seed.y ^ streamSeed(uvec2(0u), 0u, runSeed(), 0u).y);
        PROBE(segments, s.d);
        PROBE(k, s.k);
        PROBE_CHOICE(reconnectsTo, reconnectionKind(s), "nothing|surface|surface, then a light sample|emitter|environment|light sample");
        PROBE_CHOICE(technique, s.nee, "BSDF sampling|light sampling");
        PROBE_CHOICE(light, s.light, "triangle|environment|punctual");
        PROBE(lightPdf, r.lightPdf);
        PROBE(G, r.G);
        PROBE(radiance, r.radiance);
    }
    probeAppend(place, PROBE_SCOPE_END, 0u, uvec4(0u));
}

// One factor of a Jacobian: `y` of the shifted path over `x` of the base path.
void probeFactor(uint place, float y, float x) {
    probeAppend(place, PROBE_OBJECT, 0u, uvec4(0u));
    PROBE(shifted, y);
    PROBE(base, x);
    PROBE(factor, jacobianRatio(y, x));
    probeAppend(place, PROBE_SCOPE_END, 0u, uvec4(0u));
}

// The shift of the item leads from one pixel to another, and is about both. `way`: FORTH or BACK.
void probeShift(uint way, ivec2 from, ivec2 to) {
    PROBE_ABOUT(from);
    PROBE_ABOUT(to);
    if (!probeOwn) PROBE_OPEN(shifts);
    PROBE_CHOICE(way, way, "forth|back");
    PROBE(from, from);
    PROBE(to, to);
}

// What has become of it; negative: there was none.
void probeShifted(vec3 F, float jacobian) {
    PROBE_CLOSE(vertices);
    if (jacobian < 0.0) return;
    PROBE(jacobian, jacobian);
    if (jacobian > 0.0) PROBE(F, F);
}

#define PROBE_RESERVOIR(name, r) probeReservoir(PROBE_PLACE, r)
#define PROBE_FACTOR(name, y, x) probeFactor(PROBE_PLACE, y, x)
#define PROBE_SHIFT(way, from, to) probeShift(way, from, to)
#define PROBE_SHIFTED(F, jacobian) probeShifted(F, jacobian)
#else
#define PROBE_RESERVOIR(name, r)
#define PROBE_FACTOR(name, y, x)
#define PROBE_SHIFT(way, from, to)
#define PROBE_SHIFTED(F, jacobian)
#endif
