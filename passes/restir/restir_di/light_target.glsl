// SPDX-License-Identifier: MIT
// What a light point would send to the camera by way of a pixel's surface: the integrand of direct light without visibility, in the light
// point's own measure. Points keep their identity from pixel to pixel, so that reuse has no Jacobian.
#include "bsdf/material.glsl"
#include "light/light.glsl"
#include "light_reservoir.h"
#include "restir/mis.glsl"
#include "restir/ris.glsl"
#include "restir/neighbours.glsl"
#include "world/camera.glsl"
#include "world/exposure.glsl"

/// A frame's World as a pixel sees it.
World atPixel(World w, ivec2 pixel) { return atTime(w, numberOfPixel(w, pixel)); }

/// The surface that a pixel sees, ready to be lit.
struct LitSurface {
    bool sky;  // there is none
    Surface s;
    Bsdf b;
    vec3 wo;
    LobeChances chance;
};

/// `h`: what pixel `p` of an image of `size` pixels sees.
LitSurface litSurface(World w, ivec2 p, uvec2 size, PrimaryHit h) {
    LitSurface l;
    l.sky = h.primitive == NONE;
    if (l.sky) return l;
    l.wo = -cameraRay(w, filmOf(p, h.film, size), h.lens).direction;
    l.s = surfaceAt(w, hitOf(h), -l.wo);
    l.b = bsdfAt(w, l.s);
    l.chance = lobeProbabilities(l.b, l.wo);
    return l;
}

/// Density of the point in its own measure: per area, per steradian of the environment; the chance of a light without extent.
float pointDensity(World w, LightSample l) {
    float density = vertexDensity(w, l);
    return l.delta || l.distance >= FAR ? density : density * l.cosine / square(l.distance);
}

/// f |cos| L of the light point seen from the surface, per its own measure.
vec3 arriving(World w, LitSurface l, LightSample light) {
    float pdf;
    return bsdfEval(l.b, l.chance, l.wo, light.direction, pdf) * light.radianceOverPdf * pointDensity(w, light);
}

LightPoint lightPoint(LightReservoir r) { return LightPoint(r.light, r.texel, r.uv); }

/// p^ of the reservoir's point at another surface.
float targetAt(World w, LitSurface l, LightReservoir r) {
    if (l.sky || r.W <= 0.0 || r.light == NONE) return 0.0;
    return luminance(arriving(w, l, lightSampleAt(w, lightPoint(r), l.s.position)));
}
