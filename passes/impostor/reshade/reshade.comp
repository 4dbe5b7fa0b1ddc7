// SPDX-License-Identifier: MIT
// Light samples and BSDF samples by one lattice for all pixels, weighed against each other by the balance heuristic. Of directions that the BSDF chooses only
// the environment is asked, so lights of some extent are left to light samples.
#version 460
#define TEXEL_SURFACES 1
#include "pass.glsl"
#include "lattice.glsl"
#include "light/light.glsl"
#include "shaded.glsl"
#include "trace/trace.glsl"
#include "world/camera.glsl"

struct Path {
    Shaded shown;
    Lobes lobes;     // of its commonest material
    vec3 radiance;
    vec3 adds;       // what the ray brings where nothing is in its way
    Ray ray;
};

bool isMixed(Shaded shown) { return shown.materials > 1u; }

uint pathItems(World now) { return 2u * uint(params.samples); }
World pathWorld(World now, uint item) { return now; }

void pathStart(inout Path p, World now, ivec2 pixel) {
    p.shown = shadedAt(now, pixel);
    p.radiance = vec3(0.0);
    if (p.shown.alpha == 0.0) return;
    p.lobes = lobesOf(now, p.shown, 0u);
    for (uint i = 0u; i < p.shown.materials; ++i) p.radiance += shareOf(p.shown, i) * emissionOf(now, p.shown, i);
}

/// Is light that was found with density pdf left to light samples alone, or would directions of the BSDF find it as well?
float lightShare(World w, LightSample l, float pdf) { return l.point.light == w.environmentLight ? misWeight(l.pdf, pdf) : 1.0; }

void sampleLights(inout Path p, World w, uint i) {
    LightSample l = sampleLight(w, p.shown.surface.position, latticeBits3(i), lattice3(i));
    if (l.radianceOverPdf == vec3(0.0)) return;
    for (uint m = 0u; m < p.shown.materials; ++m) {
        Lobes lobes = p.lobes;
        if (isMixed(p.shown)) lobes = lobesOf(w, p.shown, m);
        float pdf;
        vec3 f = bsdfEval(lobes.bsdf, lobes.chance, p.shown.surface.view, l.direction, pdf);
        p.adds += shareOf(p.shown, m) * f * l.radianceOverPdf * lightShare(w, l, pdf);
    }
    p.ray = shadowRay(w, p.shown.surface, l);
}

/// Each material has a direction of its own. With shadows there is one ray, so they take turns by their shares, and each has fewer.
void sampleLobes(inout Path p, World w, uint i) {
    uint turn = materialAt(p.shown, (float(i) + 0.5) / float(params.samples));
    for (uint m = 0u; m < p.shown.materials; ++m) {
        if (params.shadows && m != turn) continue;
        Lobes lobes = p.lobes;
        if (isMixed(p.shown)) lobes = lobesOf(w, p.shown, m);
        BsdfSample next = bsdfSample(lobes.bsdf, lobes.chance, p.shown.surface.view, lattice3(i));
        if (next.pdf == 0.0 || next.weight == vec3(0.0)) continue;
        float share = (params.shadows ? 1.0 : shareOf(p.shown, m)) * (next.delta ? 1.0 : misWeight(next.pdf, environmentPdf(w, next.wi)));
        p.adds += next.weight * environmentRadiance(w, next.wi) * share;
        p.ray = spawnRay(w, p.shown.surface, next.wi);
    }
}

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    if (p.shown.alpha == 0.0) return false;
    p.adds = vec3(0.0);
    if (item < uint(params.samples)) sampleLights(p, w, item);
    else sampleLobes(p, w, item - uint(params.samples));
    if (p.adds == vec3(0.0)) return false;
    if (params.shadows) return true;
    p.radiance += p.adds / float(params.samples);
    return false;
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) {
    anyHit = true;
    purpose = RAYS_NEE;
    return p.ray;
}

bool pathStep(inout Path p, World w, Hit hit) {
    p.radiance += p.adds * transmittance(hit) / float(params.samples);
    return false;
}

void pathItemEnd(inout Path p, World w, ivec2 pixel, uint item) {}

void pathEnd(Path p, ivec2 pixel) {
    storeColor(pixel, vec4(p.radiance, p.shown.alpha));
    storeDepth(pixel, p.shown.depth);
}

#include "trace/driver.glsl"
