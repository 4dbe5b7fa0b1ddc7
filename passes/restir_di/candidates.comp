// SPDX-License-Identifier: MIT
// Candidates of this frame, light samples and one BSDF sample, merged with last frame's light point. Visibility is left to the end: it is no
// part of the target (Bitterli et al. 2020, Spatiotemporal Reservoir Resampling, section 3).
#version 460
#include "pass.glsl"
#include "light_target.glsl"
#include "trace/trace.glsl"

struct Path {
    Ray ray;
    BsdfSample next;
    Ris ris;
    LightReservoir kept;
    vec3 mirrored;
    uvec2 decisions;
};

World scene = world();

uint pathItems() { return 1; }
World pathWorld(uint item) { return scene; }

// Offers a point of weight w; pHat is its target here.
void offer(inout Path p, LightPoint point, float pHat, float w, float u) {
    if (risAdd(p.ris, w, u)) p.kept = LightReservoir(point.light, point.uv, 0, 0, pHat);
}

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    p.ris = risStart();
    p.kept = LightReservoir(NONE, vec2(0), 0, 0, 0);
    p.mirrored = vec3(0);
    p.decisions = resamplingSeed(uvec2(pixel), frameIndex(), runSeed(), passSalt());
    LitSurface l = litSurface(w, hits(pixelIndex(pixel)));
    if (l.sky) return false;
    uvec2 seed = pathSeed(uvec2(pixel), frameIndex(), runSeed());
    float count = float(params.candidates);
    bool lit = !bsdfAllDelta(l.b, l.wo);
    for (uint i = 0; lit && i < uint(params.candidates); ++i) {
        uint tag = i << 8;
        LightSample light = sampleLight(w, l.s.position, randomBits3(seed, 1, RANDOM_LIGHT_CHOICE | tag), random3(seed, 1, RANDOM_LIGHT_POINT | tag));
        if (light.radianceOverPdf == vec3(0)) continue;
        float pdf;
        float sent = luminance(bsdfEval(l.b, l.wo, light.direction, pdf) * light.radianceOverPdf);
        float share = light.delta ? 1 : misWeight(count * light.pdf, pdf);
        offer(p, light.point, sent * pointDensity(light), sent * share / count, random1(p.decisions, i, RANDOM_FREE));
    }
    p.next = bsdfSample(l.b, l.wo, random3(seed, 1, RANDOM_BSDF));
    p.ray = spawnRay(w, l.s, p.next.wi);
    return p.next.pdf > 0 && p.next.weight != vec3(0);
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) {
    anyHit = false;
    purpose = RAYS_CONTINUE;
    return p.ray;
}

// The light that the BSDF sample has found.
bool pathStep(inout Path p, World w, Hit hit) {
    vec3 direction = p.ray.direction, radiance, left = vec3(1);
    LightPoint point = LightPoint(w.environmentLight, environmentUv(w, direction));
    float pdfLight, perPoint = 1;  // steradians per measure of the point
    if (hit.primitive == NONE) {
        radiance = environmentRadiance(w, direction);
        pdfLight = environmentPdf(w, direction);
    } else {
        Surface s = surfaceAt(w, hit, direction);
        radiance = emittedRadiance(w, s) * segmentTransmittance(w, s, hit.t);
        pdfLight = lightPdf(w, hit.instance, hit.primitive, direction, hit.t);
        uint first = w.instances.at[hit.instance].firstLight, emitter = w.emitters.at[hit.primitive];
        point = LightPoint(first == NONE || emitter == NONE ? NONE : first + emitter, hit.barycentrics);
        perPoint = abs(dot(s.normal, direction)) / square(hit.t);
    }
    vec3 sent = p.next.weight * radiance;
    if (p.next.delta || pdfLight == 0) {  // no light sample finds it
        p.mirrored = sent;
        return false;
    }
    float share = misWeight(p.next.pdf, float(params.candidates) * pdfLight);
    offer(p, point, luminance(sent) * p.next.pdf * perPoint, luminance(sent) * share, random1(p.decisions, uint(params.candidates), RANDOM_FREE));
    return false;
}

// Merges with the point that last frame held where the pixel was: generalised balance heuristic of two.
void mergeHistory(inout Path p, World w, ivec2 pixel) {
    p.kept.M = 1;
    p.kept.W = contributionWeight(p.ris, p.kept.pHat);
    ivec2 before = pixelBefore(pixel, motion(pixel));
    if (!historyValid() || params.cap == 0) return;
    if (!inside(before)) return;
    World last = worldPrev();
    PrimaryHit here = hits(pixelIndex(pixel)), there = hitsPrev(pixelIndex(before));
    if (!similarViews(pixelView(w, here), pixelView(last, there), params.normal, params.depth)) return;
    LightReservoir past = history(pixelIndex(before)), own = p.kept;
    past.M = cappedConfidence(past.M, params.cap);
    float pastTarget = targetAt(w, litSurface(w, here), past), back = targetAt(last, litSurface(last, there), own);
    Ris ris = risStart();
    vec2 u = random2(p.decisions, 0, RANDOM_FREE + 1);
    risAdd(ris, resamplingWeight(balanceMis(own.M * own.pHat, past.M * back), own.pHat, own.W, 1), u.x);
    float m = balanceMis(past.M * past.pHat, own.M * pastTarget);
    if (risAdd(ris, resamplingWeight(m, pastTarget, past.W, 1), u.y)) {
        p.kept = past;
        p.kept.pHat = pastTarget;
    }
    p.kept.W = contributionWeight(ris, p.kept.pHat);
    p.kept.M = own.M + past.M;
}

void pathEnd(Path p, World w, ivec2 pixel) {
    mergeHistory(p, w, pixel);
    storeMerged(pixelIndex(pixel), p.kept);
    storeMirrored(pixel, vec4(p.mirrored, 1));
}

#include "trace/driver.glsl"
