// SPDX-License-Identifier: MIT
// If these fail, reservoirs keep candidates with a wrong chance or weigh them wrongly: every reused image is biased.
// groups: 64
// passes: 2
#version 460
#include "base/math.glsl"
#include "base/random.glsl"
#include "base/test.glsl"
#include "restir/ris.glsl"
layout(local_size_x = 64) in;

const uint LANES = 4096u, RUNS = 64u, COUNTS = 3u, SUMS = 64u;
const float WEIGHTS[8] = float[](0.5, 0.0, 3.0, 1.0, 0.25, 2.0, 0.0, 1.25);  // sum 8

// Resamples `count` uniform candidates of [0, 1) towards x: the estimate of the integral of x^2.
float estimate(uvec2 seed, uint count) {
    Ris r = risStart();
    float kept = 0.0;
    for (uint i = 0u; i < count; ++i) {
        vec2 u = random2(seed, i, 0u);
        if (risAdd(r, resamplingWeight(1.0 / float(count), u.x, 1.0, 1.0), u.y)) kept = u.x;
    }
    return kept * kept * contributionWeight(r, kept);
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (testPush.pass == 0u) {
        for (uint run = 0u; run < RUNS; ++run) {
            Ris r = risStart();
            uint kept = 8u;
            for (uint i = 0u; i < 8u; ++i)
                if (risAdd(r, WEIGHTS[i], random1(uvec2(id, run), i, 1u))) kept = i;
            EXPECT_EQ(r.wSum, 8.0);
            EXPECT_TRUE(kept < 8u);
            atomicAdd(testScratch[kept], 1u);
        }
        for (uint n = 0u; n < COUNTS; ++n) {
            vec2 sums = vec2(0.0);
            for (uint run = 0u; run < RUNS; ++run) {
                float error = estimate(uvec2(id, run), 1u << (2u * n)) - 1.0 / 3.0;
                sums += vec2(error, error * error);
            }
            testFloats[SUMS + (n * LANES + id) * 2u] = sums.x;
            testFloats[SUMS + (n * LANES + id) * 2u + 1u] = sums.y;
        }
        return;
    }
    if (id == 0u) {
        float total = float(LANES * RUNS), chiSquare = 0.0;
        for (uint i = 0u; i < 8u; ++i) {
            float expected = WEIGHTS[i] / 8.0 * total, difference = float(testScratch[i]) - expected;
            if (expected > 0.0) chiSquare += difference * difference / expected;
            else EXPECT_EQ(testScratch[i], 0u);
        }
        EXPECT_NEAR(chiSquare, 0.0, chiSquareLimit(5u));
        // Known answers and bad input.
        float one = testFloats[1] == -1.0 ? 2.0 : 1.0, zero = one - 1.0;  // not known when compiling
        EXPECT_EQ(finiteWeight(zero / zero), 0.0);
        EXPECT_EQ(finiteWeight(one / zero), 0.0);
        EXPECT_EQ(finiteWeight(-one), 0.0);
        EXPECT_EQ(finiteWeight(3.0 * one), 3.0);
        EXPECT_EQ(resamplingWeight(0.5, 3.0, 4.0, 0.25), 1.5);
        EXPECT_EQ(resamplingWeight(0.5, 3.0, 4.0, 0.0), 0.0);
        Ris r = risStart();
        EXPECT_EQ(risAdd(r, 0.0, 0.0), false);
        EXPECT_EQ(risAdd(r, -one, 0.0), false);
        EXPECT_EQ(risAdd(r, zero / zero, 0.0), false);
        EXPECT_EQ(contributionWeight(r, 2.0), 0.0);
        EXPECT_EQ(risAdd(r, 3.0, unitFloat(0xffffffffu)), true);  // the first is kept for every u
        EXPECT_EQ(risAdd(r, 1.0, 0.25), false);                   // at exactly its share the old one stays
        EXPECT_EQ(risAdd(r, 4.0, 0.49), true);
        EXPECT_EQ(contributionWeight(r, 2.0), 4.0);
        EXPECT_EQ(contributionWeight(r, 0.0), 0.0);
        EXPECT_EQ(cappedConfidence(35.0, 20.0) + 1.0, 21.0);
        EXPECT_EQ(cappedConfidence(3.0, 20.0) + 1.0, 4.0);
        return;
    }
    if (id > COUNTS) return;
    uint n = id - 1u;
    float sum = 0.0, squares = 0.0, count = float(LANES * RUNS);
    for (uint lane = 0u; lane < LANES; ++lane) {
        sum += testFloats[SUMS + (n * LANES + lane) * 2u];
        squares += testFloats[SUMS + (n * LANES + lane) * 2u + 1u];
    }
    float variance = squares / count - square(sum / count);
    EXPECT_NEAR(sum / count, 0.0, 4.0 * sqrt(variance / count));
    // One candidate: variance of x^2, 4 / 45. Many: of x^2 under the density 2 x, times (1/2 / x)^2: 1 / 8 - 1 / 9 = 1 / 72.
    if (n == 0u) EXPECT_NEAR(variance, 4.0 / 45.0, 1e-3);
    if (n == 2u) EXPECT_TRUE(variance > 1.0 / 72.0 && variance < 1.0 / 40.0);
}
