// SPDX-License-Identifier: MIT
// Each neighbour costs two shifts: its path to this pixel, and this pixel's path to it, for the MIS weight of the own path.
#version 460
#include "pass.glsl"
#include "restir/mis.glsl"
#include "restir/ris.glsl"
#include "restir/shift.glsl"
#include "restir/neighbours.glsl"
#include "restir/similar_pixels.glsl"

struct Path {
    Shift shift;
    Reservoir own;
    SampleHit ownHit;
    PixelView view;
    PairwiseMis pairs;
    float ownShare;      // m of the own path so far
    ivec2 neighbour;
    float confidence;    // of the neighbour, 0: none
    float pHat;          // of the neighbour's path where it was made
    float W;
    Ris ris;
    Reservoir kept;
    SampleHit keptHit;
    vec3 radiance;       // sum of F w / p^ over the candidates
};

World scene = world();
uint place(ivec2 p) { return pixelIndex(p); }

Reservoir inputReservoir(ivec2 p) {
    if (argument(1) == 0) return pathsReservoirs(place(p));
    return argument(1) == 1 ? madePathsReservoirs(place(p)) : betweenReservoirs(place(p));
}
SampleHit inputSample(ivec2 p) {
    if (argument(1) == 0) return pathsSamples(place(p));
    return argument(1) == 1 ? madePathsSamples(place(p)) : betweenSamples(place(p));
}

uvec2 decisions(ivec2 pixel) { return resamplingSeed(uvec2(pixel), frameIndex(), runSeed(), passSalt() + argument(0)); }

// Neighbour i of the pixel, which sees `mine`; the pixel itself where there is none.
ivec2 neighbourOf(ivec2 pixel, PixelView mine, uint i) {
    ivec2 q = pixelInDisk(pixel, params.radius, random2(decisions(pixel), i, RANDOM_FREE));
    if (!inside(q)) return pixel;
    return similarPixels(mine, pixelView(scene, hits(place(q)))) ? q : pixel;
}

void begin(inout Path p, ivec2 pixel) {
    p.own = inputReservoir(pixel);
    p.ownHit = inputSample(pixel);
    p.view = pixelView(scene, hits(place(pixel)));
    float sum = 0;
    for (uint i = 0; i < uint(params.neighbours); ++i) {
        ivec2 q = neighbourOf(pixel, p.view, i);
        if (q != pixel) sum += confidence(inputReservoir(q));
    }
    float mine = confidence(p.own);
    p.pairs = params.mis == mis_pairwise ? pairwiseMis(mine, sum) : defensivePairwiseMis(mine, sum);
    p.ownShare = p.pairs.start;
    p.ris = risStart();
    p.radiance = vec3(0);
    p.kept = emptyReservoir(0);
    p.keptHit = p.ownHit;
}

// Offers a candidate to the reservoir: its path here, weight w.
void offer(inout Path p, ivec2 pixel, uint number, Reservoir path, SampleHit hit, float w) {
    float pHat = target(path);
    if (pHat > 0) p.radiance += path.F * (w / pHat);
    if (!risAdd(p.ris, w, random1(decisions(pixel), number, RANDOM_FREE + 1))) return;
    p.kept = path;
    p.keptHit = hit;
}

// Takes in what a shift has given: even ones bring a neighbour's path here, odd ones the own path there.
void finish(inout Path p, ivec2 pixel, uint item) {
    if (p.confidence == 0) return;
    Shift t = p.shift;
    if ((item & 1) == 0) {
        float pHat = target(t.path), m = neighbourMis(p.pairs, p.confidence, pHat, pHatFromForward(p.pHat, t.jacobian));
        if (t.jacobian > 0) offer(p, pixel, item, t.path, t.hit, resamplingWeight(m, pHat, p.W, t.jacobian));
    } else if (holdsPath(p.own)) {
        p.ownShare += canonicalMis(p.pairs, p.confidence, target(p.own), pHatFromReverse(target(t.path), t.jacobian));
    }
}

uint pathItems() { return 2 * uint(params.neighbours); }
World pathWorld(uint item) { return scene; }

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    if (item == 0) begin(p, pixel);
    else finish(p, pixel, item - 1);
    ivec2 to = p.neighbour;
    Reservoir path = p.own;
    SampleHit hit = p.ownHit;
    if ((item & 1) == 0) {
        p.neighbour = neighbourOf(pixel, p.view, item >> 1);
        p.confidence = 0;
        if (p.neighbour == pixel) return false;
        to = pixel;
        path = inputReservoir(p.neighbour);
        hit = inputSample(p.neighbour);
        p.confidence = confidence(path);
        p.pHat = target(path);
        p.W = path.W;
    }
    return shiftStart(p.shift, w, path, hit, to, frameSize(), hits(place(to)), 1, false) && p.confidence > 0;
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) { return shiftRay(p.shift, anyHit, purpose); }
bool pathStep(inout Path p, World w, Hit hit) { return shiftStep(p.shift, w, rules(), hit); }

void pathEnd(Path p, World w, ivec2 pixel) {
    uint items = pathItems();
    finish(p, pixel, items - 1);
    offer(p, pixel, items, p.own, p.ownHit, resamplingWeight(p.ownShare, target(p.own), p.own.W, 1));
    p.kept.W = contributionWeight(p.ris, target(p.kept));
    setConfidence(p.kept, p.pairs.canonical + p.pairs.neighbours);
    if (argument(2) != 0) {
        storePathsReservoirs(place(pixel), p.kept);
        storePathsSamples(place(pixel), p.keptHit);
    } else {
        storeBetweenReservoirs(place(pixel), p.kept);
        storeBetweenSamples(place(pixel), p.keptHit);
    }
    if (argument(0) + 1 == uint(params.rounds)) storeColor(pixel, vec4(p.radiance, 1));
}

#include "trace/driver.glsl"
