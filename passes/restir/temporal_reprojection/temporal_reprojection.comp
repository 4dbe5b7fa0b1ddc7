// SPDX-License-Identifier: MIT
// Two shifts a pixel: last frame's path into this frame, and, for the MIS weights, this frame's path into last frame's scene.
#version 460
#include "pass.glsl"
#include "rate/walk.glsl"
#include "restir/mis.glsl"
#include "restir/ris.glsl"
#include "restir/shift.glsl"
#include "restir/history.glsl"
#include "restir/similar_pixels.glsl"
#include "restir/suffix.glsl"

struct Reuse {
    Reservoir own, past;
    SampleHit ownHit, pastHit;
    ivec2 before;       // where the pixel was
    float confidence;   // of the past path, capped; 0: none
    bool refresh;
    float pastTarget;   // p^ of the past path where it was made
    float jacobian;     // of its shift, after which `past` and `pastHit` are the path in this frame
    float back;         // what the own path's target would have been in last frame, by the area of this one
};

uint place(ivec2 p) { return pixelIndex(p); }

uint reusePartners() { return historyValid() ? 1 : 0; }
World reuseWorld(World now, uint partner, uint way) {
    if (way == FORTH) return now;
    return worldPrev();
}

void reuseStart(inout Reuse r, World w, ivec2 pixel) {
    r.own = pathsReservoirs(place(pixel));
    r.ownHit = pathsSamples(place(pixel));
    r.before = pixelBefore(pixel, motion(pixel));
    r.confidence = r.jacobian = r.back = 0;
    if (!historyValid() || !inFrame(r.before) || isSkipped(pixel)) return;
    r.before = standIn(r.before);
    World last = worldPrev();
    PixelView here = pixelView(w, hits(place(pixel))), there = pixelView(last, hitsPrev(place(r.before)));
    if (params.depth < 1e6 && !similarPixels(here, there)) return;
    r.past = historyReservoirs(place(r.before));
    r.pastHit = historySamples(place(r.before));
    r.pastTarget = target(r.past);
    r.confidence = cappedConfidence(confidence(r.past), historyCap(pixel) * max(confidence(r.own), 1));  // 0: a pixel that was not traced keeps its history
    r.refresh = walksSuffix(w, last);
}

ShiftTask reuseTask(inout Reuse r, World w, ivec2 pixel, uint partner, uint way) {
    if (r.confidence == 0) return shiftOfNothing();
    ShiftTask task;
    PROBE_SHIFT(way, way == FORTH ? r.before : pixel, way == FORTH ? pixel : r.before);
    if (way == FORTH) task = shiftTo(pixel, hits(place(pixel)), r.past, r.pastHit);
    else task = shiftTo(r.before, hitsPrev(place(r.before)), r.own, r.ownHit);
    task.refresh = r.refresh;
    return task;
}

void reuseResult(inout Reuse r, ivec2 pixel, uint partner, uint way, Shift result) {
    if (r.confidence == 0) return;
    if (way == BACK) {
        r.back = pHatFromReverse(target(result.path), result.jacobian);
        return;
    }
    float W = r.past.W;
    r.jacobian = result.jacobian;
    r.past = result.path;
    r.past.W = W;
    r.pastHit = result.hit;
}

void reuseEnd(Reuse r, ivec2 pixel) {
    Reservoir kept = r.own;
    SampleHit keptHit = r.ownHit;
    float mine = confidence(r.own);
    vec3 radiance = shadeReservoir(r.own);
    PROBE_RESERVOIR(own, r.own);
    PROBE(before, r.before);
    PROBE(confidencePast, r.confidence);
    if (r.confidence > 0) {
        // Generalised balance heuristic of two (Lin et al. 2022, Eq. 36).
        float mOwn = balanceMis(mine * target(r.own), r.confidence * r.back);
        float mPast = balanceMis(r.confidence * pHatFromForward(r.pastTarget, r.jacobian), mine * target(r.past));
        Ris ris = risStart();
        uvec2 decisions = resamplingSeed(uvec2(pixel), frameIndex(), runSeed(), passSalt());
        vec2 u = random2(decisions, 0, RANDOM_FREE);
        PROBE_OPEN(candidates);
        PROBE_TEXT(path, "own");
        PROBE(confidence, mine);
        PROBE(targetFrom, r.back);
        float wOwn = resamplingWeight(mOwn, target(r.own), r.own.W, 1);
        risAdd(ris, wOwn, u.x);
        PROBE_OPEN(candidates);
        PROBE_TEXT(path, "past");
        PROBE(confidence, r.confidence);
        PROBE(targetFrom, pHatFromForward(r.pastTarget, r.jacobian));
        float wPast = r.jacobian > 0 ? resamplingWeight(mPast, target(r.past), r.past.W, r.jacobian) : 0;
        radiance = candidateRadiance(r.own, wOwn) + candidateRadiance(r.past, wPast);
        if (risAdd(ris, wPast, u.y)) {
            kept = r.past;
            keptHit = r.pastHit;
        }
        kept.W = contributionWeight(ris, target(kept));
        PROBE_CLOSE(candidates);
        setConfidence(kept, mine + r.confidence);
    }
    PROBE_RESERVOIR(kept, kept);
    PROBE(color, radiance);
    storePathsReservoirs(place(pixel), kept);
    storePathsSamples(place(pixel), keptHit);
    storeColor(pixel, vec4(radiance, 1));
}

#include "restir/reuse_driver.glsl"
