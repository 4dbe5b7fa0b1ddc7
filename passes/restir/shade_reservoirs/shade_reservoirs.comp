// SPDX-License-Identifier: MIT
#version 460
#include "pass.glsl"
#include "bsdf/material.glsl"
#include "light/emission.glsl"
#include "light/environment.glsl"
#include "restir/reservoir.glsl"
#include "world/camera.glsl"
#include "world/exposure.glsl"

// Light seen directly through the pixel.
vec3 emissionAt(World w, ivec2 p, PrimaryHit h) {
    vec3 direction = cameraRay(w, filmOf(p, h.film, frameSize()), h.lens).direction;
    return h.primitive == NONE ? environmentRadiance(w, direction) : emittedRadiance(w, surfaceAt(w, hitOf(h), direction));
}

vec3 radianceOf(ivec2 p, Reservoir r) {
#if HAS_color
    vec3 radiance = colorRgba(p).rgb;
#else
    vec3 radiance = shadeReservoir(r);
#endif
#if HAS_add
    radiance += addRgba(p).rgb;
#endif
#if HAS_hits
    if (params.emission) radiance += emissionAt(atTime(world(), numberOfPixel(world(), p)), p, hits(pixelIndex(p)));
#endif
    return radiance;
}

// What the reservoir holds, as colours.
vec3 contentOf(ivec2 p, Reservoir r) {
    if (params.view == view_confidence) return vec3(confidence(r) / 20);
    if (!holdsPath(r)) return vec3(0);
    PathShape shape = unpackShape(r.shape);
    if (params.view == view_segments) return vec3(float(shape.d) / 8);
    if (params.view == view_reconnection) return vec3(float(shape.k) / 8);
    if (params.view == view_technique) return vec3(shape.nee, !shape.nee, shape.light == PATH_LIGHT_ENVIRONMENT);
    return vec3(pathsSamples(pixelIndex(p)).hit.film, 0);
}

void main() {
    if (skip()) return;
    ivec2 p = pixel();
    Reservoir r = pathsReservoirs(pixelIndex(p));
    storeColor(p, vec4(params.view == view_radiance ? radianceOf(p, r) : contentOf(p, r), 1));
}
