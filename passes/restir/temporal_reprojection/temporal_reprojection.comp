// SPDX-License-Identifier: MIT
// Two shifts a pixel: last frame's path into this frame, and, for the MIS weights, this frame's path into last frame's scene.
#version 460
#include "pass.glsl"
#include "restir/mis.glsl"
#include "restir/ris.glsl"
#include "restir/shift.glsl"
#include "restir/neighbours.glsl"
#include "restir/similar_pixels.glsl"
#include "restir/suffix.glsl"

struct Path {
    Shift shift;
    Reservoir own, past;
    SampleHit ownHit, pastHit;
    ivec2 before;       // where the pixel was
    float confidence;   // of the past path, capped; 0: none
    bool refresh;
    float jacobian;     // of the past path's shift, which gave `past` and `pastHit`
    float pastTarget;   // p^ of the past path where it was made
};

World scene = world();
uint place(ivec2 p) { return pixelIndex(p); }

uint pathItems() { return historyValid() ? 2 : 0; }
World pathWorld(uint item) {
    if (item == 0) return scene;
    return worldPrev();
}

void begin(inout Path p, ivec2 pixel) {
    p.own = pathsReservoirs(place(pixel));
    p.ownHit = pathsSamples(place(pixel));
    p.before = pixelBefore(pixel, motion(pixel));
    p.confidence = 0;
    p.jacobian = 0;
    if (!historyValid()) return;
    if (!inside(p.before)) return;
    World last = worldPrev();
    PixelView here = pixelView(scene, hits(place(pixel))), there = pixelView(last, hitsPrev(place(p.before)));
    if (params.depth < 1e6 && !similarPixels(here, there)) return;
    p.past = historyReservoirs(place(p.before));
    p.pastHit = historySamples(place(p.before));
    p.pastTarget = target(p.past);
    p.confidence = cappedConfidence(confidence(p.past), params.cap * confidence(p.own));
    p.refresh = walksSuffix(scene, last);
}

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    if (item == 0) begin(p, pixel);
    if (p.confidence == 0) return false;
    if (item == 0) return shiftStart(p.shift, w, p.past, p.pastHit, pixel, frameSize(), hits(place(pixel)), 1, p.refresh);
    float W = p.past.W;
    p.jacobian = p.shift.jacobian;
    p.past = p.shift.path;
    p.past.W = W;
    p.pastHit = p.shift.hit;
    return shiftStart(p.shift, w, p.own, p.ownHit, p.before, frameSize(), hitsPrev(place(p.before)), 1, p.refresh);
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) { return shiftRay(p.shift, anyHit, purpose); }
bool pathStep(inout Path p, World w, Hit hit) { return shiftStep(p.shift, w, rules(), hit); }

void pathEnd(Path p, World w, ivec2 pixel) {
    if (pathItems() == 0) begin(p, pixel);
    Reservoir kept = p.own;
    SampleHit keptHit = p.ownHit;
    float mine = confidence(p.own);
    if (p.confidence > 0) {
        // Generalised balance heuristic of two (Lin et al. 2022, Eq. 36).
        float back = p.shift.jacobian > 0 ? pHatFromReverse(target(p.shift.path), p.shift.jacobian) : 0;
        float mOwn = balanceMis(mine * target(p.own), p.confidence * back);
        float mPast = balanceMis(p.confidence * pHatFromForward(p.pastTarget, p.jacobian), mine * target(p.past));
        Ris ris = risStart();
        uvec2 decisions = resamplingSeed(uvec2(pixel), frameIndex(), runSeed(), passSalt());
        vec2 u = random2(decisions, 0, RANDOM_FREE);
        risAdd(ris, resamplingWeight(mOwn, target(p.own), p.own.W, 1), u.x);
        if (risAdd(ris, p.jacobian > 0 ? resamplingWeight(mPast, target(p.past), p.past.W, p.jacobian) : 0, u.y)) {
            kept = p.past;
            keptHit = p.pastHit;
        }
        kept.W = contributionWeight(ris, target(kept));
        setConfidence(kept, mine + p.confidence);
    }
    storePathsReservoirs(place(pixel), kept);
    storePathsSamples(place(pixel), keptHit);
}

#include "trace/driver.glsl"
