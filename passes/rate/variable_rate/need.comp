// SPDX-License-Identifier: MIT
// Of each pixel: what it remembers, from where it was, whether it has to be traced, and how much it needs a path otherwise.
#version 460
#include "pass.glsl"
#include "bsdf/material.glsl"
#include "rate/need.glsl"
#include "rate/rate_memory.glsl"
#include "restir/neighbours.glsl"
#include "restir/reservoir.glsl"
#include "restir/similar_pixels.glsl"
#include "surface/surface.glsl"
#include "world/camera.glsl"

const float COUNTS_FROM = 0.2;  // chance of a lobe that may make a mirror of a surface: more than varnish has, seen from above
const uint FRAMES_MOST = 32u;   // that moments reach back
const uint FRAMES_TRUSTED = 4u; // fewer say nothing of the variance
const uint FEWEST_ALIKE = 2u;   // neighbours that leave anything to be reused

// Perceptual roughness of the smoothest lobe that counts.
float smoothestLobe(World w, ivec2 p, PrimaryHit h) {
    vec3 direction = cameraRay(w, filmOf(p, h.film, frameSize()), h.lens).direction;
    Bsdf b = bsdfAt(w, surfaceAt(w, hitOf(h), direction));
    LobeChances chances = lobeProbabilities(b, -direction);
    float least = 1;
    for (uint lobe = 0; lobe < LOBE_COUNT; ++lobe)
        if (lobeChance(chances, lobe) >= COUNTS_FROM) least = min(least, lobeRoughness(b, lobe));
    return least;
}

// Mean and variance of the luminance in 7x7 pixels of last frame.
vec2 spatialMoments(ivec2 p) {
    vec3 sums = vec3(0);
    for (int y = -3; y <= 3; ++y)
        for (int x = -3; x <= 3; ++x) {
            ivec2 q = p + ivec2(x, y);
            if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, colorSize()))) continue;
            float l = luminance(colorRgba(q).rgb);
            sums += vec3(l, l * l, 1);
        }
    sums.xy /= max(sums.z, 1);
    return vec2(sums.x, sums.y - sums.x * sums.x);
}

#if HAS_depths && HAS_normals
// How many of the four neighbours see the same surface.
uint neighboursAlike(ivec2 p) {
    const ivec2 steps[4] = ivec2[](ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));
    PixelView own = PixelView(depths(p) == 0, normalsRgba(p).xyz, depths(p));
    uint count = 0;
    for (int i = 0; i < 4; ++i) {
        ivec2 q = p + steps[i];
        if (!inside(q)) {
            ++count;  // nothing is known against it
            continue;
        }
        count += uint(similarPixels(own, PixelView(depths(q) == 0, normalsRgba(q).xyz, depths(q))));
    }
    return count;
}
#else
uint neighboursAlike(ivec2 p) { return 4; }
#endif

void main() {
    if (skip()) return;
    ivec2 p = pixel(), before = p;
    uint i = pixelIndex(p);
    World w = world();
    PrimaryHit h = hits(i);
#if HAS_motion
    before = pixelBefore(p, motion(p));
#endif
    bool known = historyValid() && inside(before);
    RateMemory past = RateMemory(0, 0, 0, 0);
    float luminanceBefore = 0, need = 0;
    bool must = !known;
    if (known) {
        World last = worldPrev();
        uint b = pixelIndex(before);
#if HAS_hitsPrev
        must = !similarPixels(pixelView(w, h), pixelView(last, hitsPrev(b)));
#endif
        if (w.levelsChanged.at[0] != 0 && h.primitive != NONE) must = must || w.levels.at[h.instance] != last.levels.at[h.instance];
        past = memory(b);
        if (must) past = RateMemory(0, 0, 0, 0);
        must = must || ageOf(past) + 1 >= uint(params.age);
#if HAS_color
        luminanceBefore = luminance(colorRgba(before).rgb);
        uint frames = min(framesOf(past) + 1, FRAMES_MOST);
        past.mean = mix(past.mean, luminanceBefore, 1.0 / float(frames));
        past.meanSquare = mix(past.meanSquare, luminanceBefore * luminanceBefore, 1.0 / float(frames));
        past.packed = packMemory(ratesOf(past), ageOf(past), frames);
        if (params.noise > 0) {
            vec2 moments = vec2(past.mean, past.meanSquare - past.mean * past.mean);
            if (frames < FRAMES_TRUSTED) moments = spatialMoments(before);
            need = max(need, params.noise * noiseNeed(moments.y, moments.x, frameMean(0)));
        }
#endif
#if HAS_paths
        Reservoir r = pathsReservoirs(b);
        need = max(need, params.confidence * confidenceNeed(confidence(r), params.cap));
        PathShape shape = unpackShape(r.shape);
        PrimaryHit first = pathsSamples(b).hit;
        if (params.nearness > 0 && holdsPath(r) && first.primitive != NONE && shape.k == 2 && reconnectionKind(shape) <= RC_EMITTER) {
            vec3 from = positionAt(last, pointOf(first));
            vec3 to = positionAt(last, SurfacePoint(r.rcInstance, r.rcPrimitive, pathsSamples(b).rc.barycentrics));
            need = max(need, params.nearness * nearnessNeed(distance(from, to), distance(from, last.camera.position)));
        }
#endif
#if HAS_duplication
        need = max(need, params.copies * copiesNeed(duplication(before)));
#endif
    }
    uint alike = neighboursAlike(p);
    if (params.edges > 0) {
        if (alike < 4) need = max(need, params.edges);
        must = must || alike < FEWEST_ALIKE;
    }
    if (h.primitive != NONE) {
        float roughness = smoothestLobe(w, p, h);
        need = max(need, params.specular * specularNeed(roughness));
        must = must || roughness < params.mirror;
    }
    storeCarried(i, past);
    storeNeeds(i, PixelNeed(need, uint(must && params.forced), luminanceBefore));
}
