// SPDX-License-Identifier: MIT
// Rounds of spatial reuse: each reads what the one before it made, in turns between two buffers (rounds.h). After pass.glsl; the pass has an input and
// an output `paths`, and `between`.
#include "base/random.glsl"
#include "restir/rounds.h"
#include "restir/sample_hit.h"
#include "restir/reservoir.h"

uint place(ivec2 p) { return pixelIndex(p); }

Reservoir inputReservoir(ivec2 p) {
    if (argument(1) == ROUND_INPUT) return pathsReservoirs(place(p));
    return argument(1) == ROUND_OUTPUT ? madePathsReservoirs(place(p)) : betweenReservoirs(place(p));
}
SampleHit inputSample(ivec2 p) {
    if (argument(1) == ROUND_INPUT) return pathsSamples(place(p));
    return argument(1) == ROUND_OUTPUT ? madePathsSamples(place(p)) : betweenSamples(place(p));
}

void storeRound(ivec2 p, Reservoir path, SampleHit hit) {
    if (argument(2) == ROUND_OUTPUT) {
        storePathsReservoirs(place(p), path);
        storePathsSamples(place(p), hit);
    } else {
        storeBetweenReservoirs(place(p), path);
        storeBetweenSamples(place(p), hit);
    }
}

bool lastRound() { return argument(0) + 1 == uint(params.rounds); }

/// Seed of what the round decides at random for a pixel.
uvec2 decisions(ivec2 pixel) { return resamplingSeed(uvec2(pixel), frameIndex(), runSeed(), passSalt() + argument(0)); }
/// Random bits of the round, the same for all pixels.
uvec3 roundBits() { return randomBits3(decisions(ivec2(0)), 0, RANDOM_FREE); }
