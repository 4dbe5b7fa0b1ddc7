// SPDX-License-Identifier: MIT
// Each neighbour costs two shifts: its path to this pixel, and this pixel's path to it, for the MIS weight of the own path.
#version 460
#include "pass.glsl"
#if HAS_uv
#include "lod/path_mapping.glsl"
#endif
#include "rate/walk.glsl"
#include "restir/pairwise.glsl"
#include "restir/pixel_levels.glsl"
#include "restir/ris.glsl"
#include "restir/shift.glsl"
#include "restir/neighbours.glsl"
#include "restir/pairing.glsl"
#include "restir/rounds.glsl"
#include "restir/similar_pixels.glsl"

struct Reuse {
    Reservoir own;
    SampleHit ownHit;
    PixelView view;
    PairwiseMis pairs;
    float ownShare;      // m of the own path so far
    ivec2 neighbour;     // the pixel itself: there is none
    float confidence;    // of the neighbour
    float pHat, W;       // of the neighbour's path where it was made
    Ris ris;
    Reservoir kept;
    SampleHit keptHit;
    vec3 radiance;       // sum of F w / p^ over the candidates
};

// Neighbour i of the pixel, which sees `mine`; the pixel itself where there is none.
ivec2 neighbourOf(World w, ivec2 pixel, PixelView mine, uint i) {
#if HAS_pairing
    ivec2 q = partnerOf(pairing(), drawPairing(roundBits()), i, pixel);
#else
    ivec2 q = pixelInDisk(pixel, params.radius, random2(decisions(pixel), i, RANDOM_FREE));
#endif
    if (!inFrame(q) || isSkipped(pixel)) return pixel;
    q = standIn(q);
    return similarPixels(mine, pixelView(w, hits(place(q)))) ? q : pixel;
}

#if HAS_pairing
uint reusePartners() { return pairing().slots; }
#else
uint reusePartners() { return uint(params.neighbours); }
#endif
World reuseWorld(World now, uint partner, uint way) { return now; }

void reuseStart(inout Reuse r, World w, ivec2 pixel) {
    r.own = inputReservoir(pixel);
    r.ownHit = inputSample(pixel);
    r.view = pixelView(w, hits(place(pixel)));
    float sum = 0;
    for (uint i = 0; i < reusePartners(); ++i) {
        ivec2 q = neighbourOf(w, pixel, r.view, i);
        if (q != pixel) sum += confidence(inputReservoir(q));
    }
    float mine = confidence(r.own);
    r.pairs = pairwiseOf(mine, sum);
    r.ownShare = r.pairs.start;
    PROBE_RESERVOIR(own, r.own);
    PROBE(neighboursConfidence, sum);
    PROBE(ownShareAtFirst, r.ownShare);
    r.ris = risStart();
    r.radiance = vec3(0);
    r.kept = emptyReservoir(0);
    r.keptHit = r.ownHit;
}

// Offers a candidate to the reservoir: its path here, weight w.
void offer(inout Reuse r, ivec2 pixel, uint number, Reservoir path, SampleHit hit, float w) {
    r.radiance += candidateRadiance(path, w);
    if (!risAdd(r.ris, w, random1(decisions(pixel), number, RANDOM_FREE + 1))) return;
    r.kept = path;
    r.keptHit = hit;
}

// What the path met on its way from pixel `from` may be of levels that the pixel it goes to doesn't see: x_k passes to the one it does see, what follows is
// walked anew.
void takeToLevels(World w, ivec2 from, inout ShiftTask task) {
    task.refresh = true;
#if HAS_uv
    RayNumbers numbers = RayNumbers(numberOfPixel(w, from), numberOfPixel(w, task.to));
    MappedPath mapped = mapPath(w, w, w, numbers, uv(), LevelMapping(false, true, true, false), MAP_CONNECTED, task.first, task.path, task.base);
    task.path = mapped.path;
    task.base.rc = mapped.hit.rc;
    task.jacobian = mapped.isThere ? mapped.jacobian : 0.0;
#endif
}

ShiftTask reuseTask(inout Reuse r, World w, ivec2 pixel, uint partner, uint way) {
    ivec2 to = r.neighbour;
    Reservoir path = r.own;
    SampleHit hit = r.ownHit;
    if (way == FORTH) {
        r.neighbour = neighbourOf(w, pixel, r.view, partner);
        r.confidence = 0;
        PROBE_TEXT_IF(none, "the pixel that was drawn lies off the image or is not like this one", r.neighbour == pixel);
        if (r.neighbour == pixel) return shiftOfNothing();
        to = pixel;
        path = inputReservoir(r.neighbour);
        hit = inputSample(r.neighbour);
        r.confidence = confidence(path);
        r.pHat = target(path);
        r.W = path.W;
    }
    if (r.confidence == 0) return shiftOfNothing();
    PROBE_SHIFT(way, way == FORTH ? r.neighbour : pixel, to);
    ShiftTask task = shiftTo(to, hits(place(to)), path, hit);
    if (differInLevels(rules())) takeToLevels(w, way == FORTH ? r.neighbour : pixel, task);
    return task;
}

void reuseResult(inout Reuse r, ivec2 pixel, uint partner, uint way, Shift result) {
    if (r.confidence == 0) return;
    float pHat = target(result.path);
    if (way == BACK) {
        if (holdsPath(r.own)) r.ownShare += canonicalMis(r.pairs, r.confidence, target(r.own), pHatFromReverse(pHat, result.jacobian));
        PROBE(ownShare, r.ownShare);
    } else if (result.jacobian > 0) {
        PROBE_OBJECT_OPEN(candidate);
        float m = neighbourMis(r.pairs, r.confidence, pHat, pHatFromForward(r.pHat, result.jacobian));
        offer(r, pixel, WAYS * partner, result.path, result.hit, resamplingWeight(m, pHat, r.W, result.jacobian));
    }
}

void reuseEnd(Reuse r, ivec2 pixel) {
    PROBE_OBJECT_OPEN(ownCandidate);
    offer(r, pixel, WAYS * reusePartners(), r.own, r.ownHit, resamplingWeight(r.ownShare, target(r.own), r.own.W, 1));
    PROBE_CLOSE(ownCandidate);
    r.kept.W = contributionWeight(r.ris, target(r.kept));
    setConfidence(r.kept, r.pairs.canonical + r.pairs.neighbours);
    PROBE_RESERVOIR(kept, r.kept);
    PROBE(color, r.radiance);
    storeRound(pixel, r.kept, r.keptHit);
    if (lastRound()) storeColor(pixel, vec4(r.radiance, 1));
}

#include "restir/reuse_driver.glsl"
