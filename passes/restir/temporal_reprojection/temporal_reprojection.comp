// SPDX-License-Identifier: MIT
// Two shifts a pixel: last frame's path into this frame, and, for the MIS weights, this frame's path into last frame's scene. Where the pixel's motion counts
// by fractions of a pixel its past lies on four pixels, and each gives the paths that are its.
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
    Reservoir own;
    SampleHit ownHit;
    vec2 before;         // where the pixel's corner was on last frame's film, pixels
    uint partners;       // which of the pixels that it lay on count, bits
    float confidence;    // of all of them, capped; 0: there are none
    bool refresh;
    float pHat, W;       // of the past path where it was made
    float back;          // what the own path's target would have been in last frame, by the area of this one
    Ris ris;
    Reservoir kept;
    SampleHit keptHit;
    vec3 radiance;       // sum of F w / p^ over the candidates
};

const float FRACTIONS = 1024;  // of a pixel that motion is told by

uint place(ivec2 p) { return pixelIndex(p); }

/// The pixel lay on four pixels of last frame, of which each gives the paths whose place on the film the pixel now has: no two the same ones, so together they
/// are one technique (Zhang et al. 2024, Area ReSTIR: the gather of fractional motion). Or it takes the paths of the nearest, each to the same place inside it.
bool isFractional() { return params.gather == gather_fractional && rules().pixelCamera == 0; }

uint reusePartners() { return !historyValid() ? 0 : isFractional() ? 4 : 1; }
World reuseWorld(World now, uint partner, uint way) {
    if (way == FORTH) return now;
    return worldPrev();
}

ivec2 pastPixel(Reuse r, uint partner) { return ivec2(floor(r.before)) + ivec2(partner & 1, partner >> 1); }

// Whose confidence counts, and how much, asks nothing of the samples.
void addPartner(inout Reuse r, uint partner, World last, PixelView here) {
    ivec2 past = pastPixel(r, partner);
    vec2 overlap = max(1 - abs(r.before - vec2(past)), 0);
    if (!inFrame(past) || overlap.x * overlap.y == 0) return;
    if (params.depth < 1e6 && !similarPixels(here, pixelView(last, hitsPrev(place(past))))) return;
    r.partners |= 1u << partner;
    r.confidence += overlap.x * overlap.y * confidence(historyReservoirs(place(past)));
}

void reuseStart(inout Reuse r, World w, ivec2 pixel) {
    r.own = r.kept = pathsReservoirs(place(pixel));
    r.ownHit = r.keptHit = pathsSamples(place(pixel));
    r.partners = 0;
    r.confidence = r.back = 0;
    r.radiance = shadeReservoir(r.own);
    // Any place will do that is the same for all paths of the pixel. By steps, so that what stands still has whole ones whatever its motion was rounded to.
    r.before = vec2(pixel) + round(motion(pixel) * FRACTIONS) / FRACTIONS;
    if (!historyValid() || isSkipped(pixel)) return;
    if (!isFractional()) {
        ivec2 nearest = pixelBefore(pixel, motion(pixel));
        if (!inFrame(nearest)) return;
        r.before = vec2(standIn(nearest));
    }
    World last = worldPrev();
    PixelView here = pixelView(w, hits(place(pixel)));
    for (uint i = 0; i < reusePartners(); ++i) addPartner(r, i, last, here);
    // A pixel that was not traced keeps its history.
    r.confidence = cappedConfidence(r.confidence, historyCap(pixel) * max(confidence(r.own), 1));
    r.refresh = walksSuffix(w, last);
    r.ris = risStart();
    if (r.confidence > 0) r.radiance = vec3(0);
}

uvec2 decisions(ivec2 pixel) { return resamplingSeed(uvec2(pixel), frameIndex(), runSeed(), passSalt()); }

// Offers a candidate to the reservoir: its path here, weight w. Numbers, however many pixels the past is on: 0 the own one, from 1 on past ones.
void offer(inout Reuse r, ivec2 pixel, uint number, Reservoir path, SampleHit hit, float w) {
    r.radiance += candidateRadiance(path, w);
    if (!risAdd(r.ris, w, random1(decisions(pixel), number, RANDOM_FREE))) return;
    r.kept = path;
    r.keptHit = hit;
}

ShiftTask reuseTask(inout Reuse r, World w, ivec2 pixel, uint partner, uint way) {
    if (r.confidence == 0 || (r.partners >> partner & 1u) == 0) return shiftOfNothing();
    ivec2 past = pastPixel(r, partner), to = way == FORTH ? pixel : past;
    vec2 offset = r.before - vec2(past);
    Reservoir path = r.own;
    SampleHit hit = r.ownHit;
    if (way == FORTH) {
        path = historyReservoirs(place(past));
        hit = historySamples(place(past));
        r.pHat = target(path);
        r.W = path.W;
        offset = -offset;
    }
    hit.hit.film += offset;
    bool moves = any(lessThan(hit.hit.film, vec2(0))) || any(greaterThanEqual(hit.hit.film, vec2(1)));
    PROBE_TEXT_IF(none, "its place on the film is another pixel's", moves);
    if (moves) return shiftOfNothing();
    PROBE_SHIFT(way, way == FORTH ? past : pixel, to);
    ShiftTask task;
    if (way == FORTH) task = shiftTo(to, hits(place(to)), path, hit);
    else task = shiftTo(to, hitsPrev(place(to)), path, hit);
    task.refresh = r.refresh;
    return task;
}

void reuseResult(inout Reuse r, ivec2 pixel, uint partner, uint way, Shift result) {
    if (r.confidence == 0 || result.jacobian == 0) return;
    float pHat = target(result.path);
    if (way == BACK) {
        r.back = pHatFromReverse(pHat, result.jacobian);
        return;
    }
    // Generalised balance heuristic of two (Lin et al. 2022, Eq. 36).
    PROBE_OBJECT_OPEN(candidate);
    PROBE(confidence, r.confidence);
    PROBE(targetFrom, pHatFromForward(r.pHat, result.jacobian));
    float m = balanceMis(r.confidence * pHatFromForward(r.pHat, result.jacobian), confidence(r.own) * pHat);
    offer(r, pixel, 1 + partner, result.path, result.hit, resamplingWeight(m, pHat, r.W, result.jacobian));
}

void reuseEnd(Reuse r, ivec2 pixel) {
    PROBE_RESERVOIR(own, r.own);
    PROBE(before, r.before);
    PROBE(confidencePast, r.confidence);
    if (r.confidence > 0) {
        float mine = confidence(r.own);
        PROBE_OBJECT_OPEN(ownCandidate);
        PROBE(confidence, mine);
        PROBE(targetFrom, r.back);
        float m = balanceMis(mine * target(r.own), r.confidence * r.back);
        offer(r, pixel, 0, r.own, r.ownHit, resamplingWeight(m, target(r.own), r.own.W, 1));
        PROBE_CLOSE(ownCandidate);
        r.kept.W = contributionWeight(r.ris, target(r.kept));
        setConfidence(r.kept, mine + r.confidence);
    }
    PROBE_RESERVOIR(kept, r.kept);
    PROBE(color, r.radiance);
    storePathsReservoirs(place(pixel), r.kept);
    storePathsSamples(place(pixel), r.keptHit);
    storeColor(pixel, vec4(r.radiance, 1));
}

#include "restir/reuse_driver.glsl"
