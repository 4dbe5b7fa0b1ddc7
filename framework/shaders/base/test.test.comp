// SPDX-License-Identifier: MIT
// Proves the harness that all GPU tests stand on: checks of every kind count and pass, and scratch memory outlives a pass.
// (tests/gpu_runner/ holds the tests that must fail.)
// groups: 64
// passes: 2
#version 460
#include "base/test.glsl"
#include "test.glsl"  // a second time: every file is taken once

layout(local_size_x = 64) in;

const uint BINS = 16u;
const uint SAMPLES = 64u * 64u;

uint hash(uint x) {  // a finaliser in the manner of Murmur3's: full avalanche
    x = (x ^ (x >> 16)) * 0x85ebca6bu;
    x = (x ^ (x >> 13)) * 0xc2b2ae35u;
    return x ^ (x >> 16);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (testPush.pass == 0u) {
        // One count a bin, and a sum that no order of additions rounds.
        atomicAdd(testScratch[hash(i) % BINS], 1u);
        testAdd(BINS, 0.5);
        return;
    }
    if (i >= 1u) return;

    uint total = 0u;
    float chiSquare = 0.0, expected = float(SAMPLES) / float(BINS);
    for (uint bin = 0u; bin < BINS; ++bin) {
        float difference = float(testScratch[bin]) - expected;
        chiSquare += difference * difference / expected;
        total += testScratch[bin];
    }
    EXPECT_EQ(total, SAMPLES);
    EXPECT_TRUE(chiSquare < chiSquareLimit(BINS - 1u));
    EXPECT_EQ(testFloats[BINS], 0.5 * float(SAMPLES));
    EXPECT_EQ(testScratch[TEST_SCRATCH - 1u], 0u);

    // Known quantiles of the chi-square distribution, upper tail 1e-5.
    EXPECT_NEAR(chiSquareLimit(50u), 104.542, 0.3);
    EXPECT_NEAR(chiSquareLimit(1000u), 1202.304, 0.1);

    EXPECT_NEAR(1.05, 1.0, 0.06);
    EXPECT_NEAR(vec3(1, 2, 3), vec3(1.1, 1.9, 3), 0.11);
    EXPECT_NEAR(uintBitsToFloat(0x7f800000u), uintBitsToFloat(0x7f800000u), 0.0);
    EXPECT_EQ(-3, -3);
    EXPECT_EQ(3u, 3u);
    EXPECT_EQ(i, 0);
    EXPECT_EQ(uint64_t(1) << 40, uint64_t(1) << 40);
    EXPECT_EQ(-(int64_t(1) << 40), -(int64_t(1) << 40));
    EXPECT_EQ(ivec2(-1, 1), ivec2(-1, 1));
    EXPECT_EQ(uvec4(1, 2, 3, 4), uvec4(1, 2, 3, 4));
    EXPECT_EQ(vec2(0.25, 1), vec2(0.25, 1));
    EXPECT_EQ(true, !false);
}
