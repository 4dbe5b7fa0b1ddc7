// SPDX-License-Identifier: MIT
// Candidates of this frame, light samples and one BSDF sample, merged with last frame's light point. Visibility is left to the end: it is no
// part of the target (Bitterli et al. 2020, Spatiotemporal Reservoir Resampling, section 3).
//
// A BSDF sample finds only lights that are seen. Where one is hidden light samples have to stand for all of it, or a neighbour that sees it would
// inherit too little: so the light sample that is kept is asked whether it is seen before it is weighed against the BSDF sample.
#version 460
#include "pass.glsl"
#include "light_target.glsl"
#include "restir/similar_pixels.glsl"
#include "trace/trace.glsl"

struct Path {
    Ray ray;
    bool asksLight;      // the ray goes to the light sample that was kept, not along the BSDF sample
    LightSample light;   // that sample
    float bsdfPdf;       // with which the BSDF finds it where it is seen
    BsdfSample next;
    Ray onward;          // along it
    Ris lights, ris;     // of light samples alone; of what they and the BSDF sample give
    LightReservoir kept;
    vec3 mirrored;
    uvec2 decisions;
};

uint pathItems(World now) { return 1; }
World pathWorld(World now, uint item) { return now; }
void pathStart(inout Path p, World now, ivec2 pixel) {}

bool startBsdf(inout Path p) {
    p.asksLight = false;
    p.ray = p.onward;
    return p.next.pdf > 0 && p.next.weight != vec3(0);
}

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    p.lights = p.ris = risStart();
    p.kept = LightReservoir(NONE, 0, vec2(0), 0, 0, 0, 0);
    p.mirrored = vec3(0);
    p.decisions = resamplingSeed(uvec2(pixel), frameIndex(), runSeed(), passSalt());
    w = atPixel(w, pixel);
    LitSurface l = litSurface(w, pixel, frameSize(), hits(pixelIndex(pixel)));
    if (l.sky) return false;
    uvec2 seed = pathSeed(uvec2(pixel), frameIndex(), runSeed());
    float count = float(params.candidates);
    bool lit = !bsdfAllDelta(l.b, l.chance);
    for (uint i = 0; lit && i < uint(params.candidates); ++i) {
        uint tag = i << 8;
        LightSample light = sampleLight(w, l.s.position, randomBits3(seed, 1, RANDOM_LIGHT_CHOICE | tag), random3(seed, 1, RANDOM_LIGHT_POINT | tag));
        if (light.radianceOverPdf == vec3(0)) continue;
        float pdf;
        float sent = luminance(bsdfEval(l.b, l.chance, l.wo, light.direction, pdf) * light.radianceOverPdf);
        PROBE_OPEN(lightCandidates);
        PROBE(light, light.point.light);
        PROBE(lightPdf, light.pdf);
        PROBE(bsdfPdf, pdf);
        if (!risAdd(p.lights, sent / count, random1(p.decisions, i, RANDOM_FREE))) continue;
        p.kept = LightReservoir(light.point.light, light.point.texel, light.point.uv, 0, 0, sent * pointDensity(w, light), 0);
        p.light = light;
        p.bsdfPdf = pdf;
    }
    PROBE_CLOSE(lightCandidates);
    p.next = bsdfSample(l.b, l.chance, l.wo, random3(seed, 1, RANDOM_BSDF));
    p.onward = spawnRay(w, l.s, p.next.wi);
    if (p.lights.wSum <= 0) return startBsdf(p);
    p.asksLight = true;
    p.ray = shadowRay(w, l.s, p.light);
    return true;
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) {
    anyHit = p.asksLight;
    purpose = p.asksLight ? RAYS_NEE : RAYS_CONTINUE;
    return p.ray;
}

// What the light samples give, all in one: they are as many times likelier to find a point than one of them.
void takeLight(inout Path p, bool seen) {
    float share = seen && !p.light.delta ? misWeight(float(params.candidates) * p.light.pdf, p.bsdfPdf) : 1;
    PROBE_OBJECT_OPEN(lightSample);
    PROBE(hidden, !seen);
    PROBE(share, share);
    risAdd(p.ris, p.lights.wSum * share, 0);
    PROBE_CLOSE(lightSample);
}

// The light that the BSDF sample has found.
void takeBsdf(inout Path p, World w, Hit hit) {
    vec3 direction = p.ray.direction, radiance;
    EnvironmentPoint there = environmentPoint(w, environmentUv(w, direction));
    LightPoint point = LightPoint(w.environmentLight, there.texel, there.place);
    float pdfLight, perPoint = 1;  // steradians per measure of the point
    if (hit.primitive == NONE) {
        radiance = environmentRadiance(w, direction);
        pdfLight = environmentPdf(w, direction);
    } else {
        Surface s = surfaceAt(w, hit, direction);
        radiance = emittedRadiance(w, s) * segmentTransmittance(w, s, hit.t);
        pdfLight = lightPdf(w, hit.instance, hit.primitive, direction, hit.t);
        point = LightPoint(triangleLight(w, hit.instance, hit.primitive), 0, hit.barycentrics);
        perPoint = abs(dot(s.normal, direction)) / square(hit.t);
    }
    vec3 sent = p.next.weight * radiance;
    if (p.next.delta || pdfLight == 0) {  // no light sample finds it
        p.mirrored = sent;
        return;
    }
    float share = misWeight(p.next.pdf, float(params.candidates) * pdfLight);
    PROBE_OBJECT_OPEN(bsdfSample);
    PROBE(pdfs, vec2(p.next.pdf, pdfLight));
    PROBE(sent, sent);
    PROBE(share, share);
    if (risAdd(p.ris, luminance(sent) * share, random1(p.decisions, uint(params.candidates), RANDOM_FREE)))
        p.kept = LightReservoir(point.light, point.texel, point.uv, 0, 0, luminance(sent) * p.next.pdf * perPoint, 0);
    PROBE_CLOSE(bsdfSample);
}

bool pathStep(inout Path p, World w, Hit hit) {
    if (p.asksLight) {
        takeLight(p, hit.primitive == NONE);
        return startBsdf(p);
    }
    takeBsdf(p, w, hit);
    return false;
}

// Merges with the point that last frame held where the pixel was: generalised balance heuristic of two.
void mergeHistory(inout Path p, World w, ivec2 pixel) {
    p.kept.M = 1;
    p.kept.W = contributionWeight(p.ris, p.kept.pHat);
    ivec2 before = pixelBefore(pixel, motion(pixel));
    if (!historyValid() || params.cap == 0) return;
    if (!inside(before)) return;
    World last = atPixel(worldPrev(), before);
    PrimaryHit here = hits(pixelIndex(pixel)), there = hitsPrev(pixelIndex(before));
    if (!similarPixels(pixelView(w, here), pixelView(last, there))) return;
    LightReservoir past = history(pixelIndex(before)), own = p.kept;
    past.M = cappedConfidence(past.M, params.cap);
    float pastTarget = targetAt(w, litSurface(w, pixel, frameSize(), here), past), back = targetAt(last, litSurface(last, before, frameSize(), there), own);
    PROBE_OPEN(candidates);
    PROBE_TEXT(path, "own");
    PROBE(confidence, own.M);
    PROBE(targetFrom, back);
    Ris ris = risStart();
    vec2 u = random2(p.decisions, 0, RANDOM_FREE + 1);
    risAdd(ris, resamplingWeight(balanceMis(own.M * own.pHat, past.M * back), own.pHat, own.W, 1), u.x);
    float m = balanceMis(past.M * past.pHat, own.M * pastTarget);
    PROBE_OPEN(candidates);
    PROBE_TEXT(path, "past");
    PROBE(from, before);
    PROBE(confidence, past.M);
    PROBE(targetFrom, past.pHat);
    if (risAdd(ris, resamplingWeight(m, pastTarget, past.W, 1), u.y)) {
        p.kept = past;
        p.kept.pHat = pastTarget;
    }
    p.kept.W = contributionWeight(ris, p.kept.pHat);
    p.kept.M = own.M + past.M;
}

void pathItemEnd(inout Path p, World w, ivec2 pixel, uint item) {
    mergeHistory(p, w, pixel);
    storeMerged(pixelIndex(pixel), p.kept);
    storeMirrored(pixel, vec4(p.mirrored, 1));
}

void pathEnd(Path p, ivec2 pixel) {}

#include "trace/driver.glsl"
