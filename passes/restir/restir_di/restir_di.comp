// SPDX-License-Identifier: MIT
// Spatial reuse and the shadow ray of the point that is left.
#version 460
#include "pass.glsl"
#include "light_target.glsl"
#include "restir/similar_pixels.glsl"
#include "trace/trace.glsl"

struct Path {
    Ray ray;
    LightReservoir kept;
    vec3 unshadowed, radiance;
};

uint pathItems(World now) { return 1; }
World pathWorld(World now, uint item) { return now; }
void pathStart(inout Path p, World now, ivec2 pixel) {}

uvec2 decisions(ivec2 pixel) { return resamplingSeed(uvec2(pixel), frameIndex(), runSeed(), passSalt() + 1); }

// Neighbour i of the pixel; the pixel itself where there is none.
ivec2 neighbourOf(World w, ivec2 pixel, uint i) {
    ivec2 q = pixelInDisk(pixel, params.radius, random2(decisions(pixel), i, RANDOM_FREE));
    if (!inside(q)) return pixel;
    return similarPixels(pixelView(w, hits(pixelIndex(pixel))), pixelView(w, hits(pixelIndex(q)))) ? q : pixel;
}

LightReservoir reuseNeighbours(World w, ivec2 pixel, LitSurface l) {
    LightReservoir own = merged(pixelIndex(pixel)), kept = own;
    float sum = 0;
    for (uint i = 0; i < uint(params.neighbours); ++i) {
        ivec2 q = neighbourOf(w, pixel, i);
        if (q != pixel) sum += merged(pixelIndex(q)).M;
    }
    PairwiseMis pairs = defensivePairwiseMis(own.M, sum);
    float m = pairs.start;
    Ris ris = risStart();
    for (uint i = 0; i < uint(params.neighbours); ++i) {
        ivec2 q = neighbourOf(w, pixel, i);
        if (q == pixel) continue;
        LightReservoir other = merged(pixelIndex(q));
        World seen = atPixel(world(), q);
        float here = targetAt(w, l, other), there = targetAt(seen, litSurface(seen, q, frameSize(), hits(pixelIndex(q))), own);
        PROBE_OPEN(candidates);
        PROBE(from, q);
        float weight = resamplingWeight(neighbourMis(pairs, other.M, here, other.pHat), here, other.W, 1);
        PROBE_OBJECT_OPEN(back);
        m += canonicalMis(pairs, other.M, own.pHat, there);
        PROBE_CLOSE(back);
        if (risAdd(ris, weight, random1(decisions(pixel), i, RANDOM_FREE + 1))) {
            kept = other;
            kept.pHat = here;
        }
    }
    PROBE_CLOSE(candidates);
    PROBE_OBJECT_OPEN(ownCandidate);
    if (risAdd(ris, resamplingWeight(m, own.pHat, own.W, 1), random1(decisions(pixel), uint(params.neighbours), RANDOM_FREE + 1))) kept = own;
    kept.W = contributionWeight(ris, kept.pHat);
    PROBE_CLOSE(ownCandidate);
    kept.M = own.M + sum;
    return kept;
}

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    PrimaryHit h = hits(pixelIndex(pixel));
    w = atPixel(w, pixel);
    LitSurface l = litSurface(w, pixel, frameSize(), h);
    p.kept = merged(pixelIndex(pixel));
    p.unshadowed = vec3(0);
    p.radiance = mirrored(pixel).rgb;
    if (l.sky) {
        p.radiance += environmentRadiance(w, cameraRay(w, filmOf(pixel, h.film, frameSize()), h.lens).direction);
        return false;
    }
    p.radiance += emittedRadiance(w, l.s);
    p.kept = reuseNeighbours(w, pixel, l);
    if (p.kept.W <= 0) return false;
    LightSample light = lightSampleAt(w, lightPoint(p.kept), l.s.position);
    p.unshadowed = arriving(w, l, light) * p.kept.W;
    p.ray = shadowRay(w, l.s, light);
    return true;
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) {
    anyHit = true;
    purpose = RAYS_NEE;
    return p.ray;
}

bool pathStep(inout Path p, World w, Hit hit) {
    p.radiance += p.unshadowed * transmittance(hit);
    return false;
}

void pathItemEnd(inout Path p, World w, ivec2 pixel, uint item) {}

void pathEnd(Path p, ivec2 pixel) {
    storeReservoirs(pixelIndex(pixel), p.kept);
    storeColor(pixel, vec4(p.radiance, 1));
}

#include "trace/driver.glsl"
