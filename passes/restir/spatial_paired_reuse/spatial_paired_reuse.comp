// SPDX-License-Identifier: MIT
// Resamples a pixel's path with those of its partners, which have been shifted already: no ray is traced.
#version 460
#include "pass.glsl"
#include "restir/pairing.glsl"
#include "restir/pairwise.glsl"
#include "restir/probe_path.glsl"
#include "restir/reservoir.glsl"
#include "restir/ris.glsl"
#include "restir/rounds.glsl"

uint recordOf(ivec2 p, uint slot) { return place(p) * pairing().slots + slot; }

// The path that a record is of, as it is where it was shifted to.
Reservoir shiftedPath(ivec2 partner, SharedShift shift) {
    Reservoir path = inputReservoir(partner);
    path.F = shift.F;
    path.G = shift.G;
    return path;
}
SampleHit shiftedSample(ivec2 p, ivec2 partner, uint slot) {
    SampleHit hit = inputSample(partner);
    if (rules().pixelCamera != 0u) {  // all paths of a pixel begin where its own does
        SampleHit own = inputSample(p);
        hit.hit = own.hit;
        hit.uv = own.uv;
        hit.time = own.time;
    } else {
        SharedFirstHit first = firstHits(recordOf(p, slot));
        hit.hit = PrimaryHit(first.instance, first.primitive, first.barycentrics, hit.hit.film, hit.hit.lens);
        hit.uv = first.uv;
    }
    return hit;
}

// Both ends have to agree that they are partners.
bool pairs(ivec2 pixel, ivec2 partner, uint slot) {
    return inside(partner) && shifts(recordOf(pixel, slot)).jacobian >= 0.0 && shifts(recordOf(partner, slot)).jacobian >= 0.0;
}

void main() {
    if (skip()) return;
    ivec2 p = pixel();
    PROBE_START(p);
    PairingTables tables = pairing();
    PairingDraw draw = drawPairing(roundBits());
    Reservoir own = inputReservoir(p);
    float mine = confidence(own), sum = 0, pHatOwn = target(own);
    for (uint slot = 0; slot < tables.slots; ++slot) {
        ivec2 q = partnerOf(tables, draw, slot, p);
        if (pairs(p, q, slot)) sum += confidence(inputReservoir(q));
    }
    PairwiseMis mis = pairwiseOf(mine, sum);
    float ownShare = mis.start;
    PROBE_RESERVOIR(own, own);
    PROBE(neighboursConfidence, sum);
    PROBE(ownShareAtFirst, ownShare);
    Ris ris = risStart();
    uint kept = tables.slots + 1;  // none
    vec3 radiance = vec3(0);
    for (uint slot = 0; slot < tables.slots; ++slot) {
        ivec2 q = partnerOf(tables, draw, slot, p);
        if (!pairs(p, q, slot)) continue;
        PROBE_ITEM_DONE();
        PROBE_ABOUT(q);
        PROBE_OPEN(candidates);
        PROBE(from, q);
        PROBE_OBJECT_OPEN(back);
        Reservoir other = inputReservoir(q);
        SharedShift forth = shifts(recordOf(p, slot)), back = shifts(recordOf(q, slot));
        float c = confidence(other), pHat = luminance(forth.F);
        if (holdsPath(own)) ownShare += canonicalMis(mis, c, pHatOwn, pHatFromReverse(luminance(back.F), back.jacobian));
        PROBE(jacobian, back.jacobian);
        PROBE(ownShare, ownShare);
        PROBE_CLOSE(back);
        if (forth.jacobian == 0.0) continue;
        PROBE(F, forth.F);
        float w = resamplingWeight(neighbourMis(mis, c, pHat, pHatFromForward(target(other), forth.jacobian)), pHat, other.W, forth.jacobian);
        if (pHat > 0) radiance += forth.F * (w / pHat);
        if (risAdd(ris, w, random1(decisions(p), 2 * slot, RANDOM_FREE + 1))) kept = slot;
    }
    PROBE_ITEM_DONE();
    PROBE_OBJECT_OPEN(ownCandidate);
    float w = resamplingWeight(ownShare, pHatOwn, own.W, 1);
    if (pHatOwn > 0) radiance += own.F * (w / pHatOwn);
    if (risAdd(ris, w, random1(decisions(p), 2 * tables.slots, RANDOM_FREE + 1))) kept = tables.slots;
    PROBE_CLOSE(ownCandidate);

    Reservoir path = emptyReservoir(0);
    SampleHit hit = inputSample(p);
    if (kept == tables.slots) path = own;
    if (kept < tables.slots) {
        ivec2 q = partnerOf(tables, draw, kept, p);
        path = shiftedPath(q, shifts(recordOf(p, kept)));
        hit = shiftedSample(p, q, kept);
    }
    path.W = contributionWeight(ris, target(path));
    setConfidence(path, mis.canonical + mis.neighbours);
    PROBE_RESERVOIR(kept, path);
    PROBE(color, radiance);
    storeRound(p, path, hit);
    if (lastRound()) storeColor(p, vec4(radiance, 1));
}
