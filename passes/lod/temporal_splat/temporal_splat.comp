// SPDX-License-Identifier: MIT
// Resamples the pixel's own path with those that landed in it, and with the backup.
//
// All paths of last frame together are one technique: a path of this frame has one place on last frame's film, in one pixel, and one time of last
// frame's exposure. So weights are not divided by the number of paths that land here (Liu et al. 2025, Reservoir Splatting). With a backup, the own path
// is compared with each of the two techniques in turn, pairwise, because neither's density of the other's path is known.
#version 460
#include "pass.glsl"
#include "backup.glsl"
#include "splats.glsl"
#include "restir/mis.glsl"
#include "restir/history.glsl"
#include "restir/probe_path.glsl"
#include "restir/reservoir.glsl"
#include "restir/ris.glsl"
#include "base/random.glsl"

// m of a path of last frame, made by a technique with so large a share: `from` its confidence times pHatFrom, `own` this pixel's confidence times p^.
float pastMis(float share, float from, float own) { return share * balanceMis(from, own); }

// m of the own path.
float ownMis(float own, Origins o, float backup) {
    float scattered = o.scattered > 0 ? balanceMis(own, o.scattered) : 1, gathered = o.gathered > 0 ? balanceMis(own, o.gathered) : 1;
    return mix(scattered, gathered, backup);
}

// The list of a pixel in order of its entries, so that the image doesn't depend on how threads ran.
void sortList(uint start, uint count) {
    for (uint i = 1; i < count; ++i) {
        uint entry = lists(start + i), k = i;
        for (; k > 0 && lists(start + k - 1) > entry; --k) storeLists(start + k, lists(start + k - 1));
        storeLists(start + k, entry);
    }
}

void main() {
    if (skip()) return;
    ivec2 p = pixel();
    PROBE_START(p);
    uint i = pixelIndex(p), count = counts(i), start = ends(i) - count;
    Reservoir own = pathsReservoirs(i), kept = own;
    SampleHit keptHit = pathsSamples(i);
    ivec2 before = pixelBefore(p, motion(p));
    bool hasBefore = historyValid() && inside(before);
    float inherited = hasBefore ? cappedConfidence(confidence(historyReservoirs(pixelIndex(before))), historyCap(p)) : 0;
    float backup = inherited > 0 ? backupShare() : 0;  // hangs on confidence alone, so each path of the pixel finds the same
    float mine = confidence(own);
    uvec2 decisions = resamplingSeed(uvec2(p), frameIndex(), runSeed(), passSalt());

    PROBE_RESERVOIR(own, own);
    PROBE(confidencePast, inherited);
    PROBE(backup, backup);
    PROBE(landed, count);
    PROBE_OPEN(candidates);
    PROBE_TEXT(path, "own");
    PROBE(confidence, mine);
    PROBE(fromSplatted, origins(i).scattered);
    PROBE(fromReprojected, origins(i).gathered);
    Ris ris = risStart();
    float w = resamplingWeight(ownMis(mine * target(own), origins(i), backup), target(own), own.W, 1);
    risAdd(ris, w, 0);
    vec3 radiance = candidateRadiance(own, w);
    sortList(start, count);
    for (uint k = 0; k < count; ++k) {
        uint source = lists(start + k);
        Landing landing = landings(source);
        Reservoir path = shiftedReservoirs(source);
        PROBE_OPEN(candidates);
        PROBE_TEXT(path, "splatted");
        PROBE(from, pixelOfSplat(source));
        PROBE(confidence, landing.confidence);
        PROBE(targetFrom, pHatFromForward(landing.pHat, landing.jacobian));
        float m = pastMis(1 - backup, landing.confidence * pHatFromForward(landing.pHat, landing.jacobian), mine * target(path));
        w = resamplingWeight(m, target(path), path.W, landing.jacobian);
        radiance += candidateRadiance(path, w);
        if (!risAdd(ris, w, random1(decisions, k, RANDOM_FREE))) continue;
        kept = path;
        keptHit = shiftedSamples(source);
    }
    if (backup > 0 && gatherings(i).target == i) {
        Landing landing = gatherings(i);
        Reservoir path = gatheredReservoirs(i);
        PROBE_OPEN(candidates);
        PROBE_TEXT(path, "reprojected");
        PROBE(from, before);
        PROBE(confidence, landing.confidence);
        PROBE(targetFrom, pHatFromForward(landing.pHat, landing.jacobian));
        float m = pastMis(backup, landing.confidence * pHatFromForward(landing.pHat, landing.jacobian), mine * target(path));
        w = resamplingWeight(m, target(path), path.W, landing.jacobian);
        radiance += candidateRadiance(path, w);
        if (risAdd(ris, w, random1(decisions, count, RANDOM_FREE + 1))) {
            kept = path;
            keptHit = gatheredSamples(i);
        }
    }
    PROBE_CLOSE(candidates);
    kept.W = contributionWeight(ris, target(kept));
    setConfidence(kept, mine + inherited * mix(origins(i).kept, 1, backup));
    PROBE_RESERVOIR(kept, kept);
    PROBE(color, radiance);
    storePathsReservoirs(i, kept);
    storePathsSamples(i, keptHit);
    storeColor(p, vec4(radiance, 1));
    storeLanded(p, float(count));
}
