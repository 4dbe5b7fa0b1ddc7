// SPDX-License-Identifier: MIT
// If these fail, other shares of the rays see a level than were asked for, or rays of one path see different scenes.
// groups: 1024
// passes: 3
#version 460
#define RAY_LEVELS 1
#include "world/ray_levels.glsl"
#include "world/test_world.glsl"
layout(local_size_x = 64) in;

// Instances: settled; at one, four and seven eighths; at a third, with numbers of its own; two at a half likewise.
const uint SETTLED = 0u, EIGHTH = 1u, HALF = 2u, MOST = 3u, THIRD = 4u, EACH_A = 5u, EACH_B = 6u, COUNT = 7u;

uint threshold(float share) { return uint(share * 16777216.0) << 8; }

void write() {
    TestUints levels = TestUints(testArray(TEST_EMITTERS)), dissolves = TestUints(testArray(TEST_PRIMITIVES));
    for (uint i = 0u; i < COUNT; ++i) levels.at[i] = 2u;
    dissolves.at[SETTLED] = 0u;
    dissolves.at[EIGHTH] = threshold(0.125);
    dissolves.at[HALF] = threshold(0.5);
    dissolves.at[MOST] = threshold(0.875);
    dissolves.at[THIRD] = threshold(1.0 / 3.0) | DISSOLVE_EACH;
    dissolves.at[EACH_A] = dissolves.at[EACH_B] = threshold(0.5) | DISSOLVE_EACH;
}

void main() {
    if (testPush.pass == 0u) {
        if (gl_GlobalInvocationID.x == 0u) write();
        return;
    }
    World w = testWorld();
    w.levels = UintArray(testArray(TEST_EMITTERS));
    w.dissolves = UintArray(testArray(TEST_PRIMITIVES));
    w.frameKey = 5u;
    TestUints sums = TestUints(testArray(TEST_SUMS));
    uint i = gl_GlobalInvocationID.x, all = 65536u;
    ivec2 pixel = ivec2(i & 255u, i >> 8);
    if (testPush.pass == 1u) {
        uint ofPixel = numberOfPixel(w, pixel), ofPath = numberOfPath(pathSeed(uvec2(pixel), 3u, 1u));
        EXPECT_EQ(ofPixel & ~RAY_NUMBER, 0u);
        EXPECT_EQ(ofPath & ~RAY_NUMBER, 0u);
        // Flags in the low bits change nothing.
        for (uint k = 0u; k < COUNT; ++k) {
            EXPECT_EQ(levelSeen(w, k, ofPixel | 1u), levelSeen(w, k, ofPixel));
            if (seesCoarser(w, k, ofPixel)) atomicAdd(sums.at[k], 1u);
            if (seesCoarser(w, k, ofPath)) atomicAdd(sums.at[COUNT + k], 1u);
        }
        EXPECT_EQ(levelSeen(w, SETTLED, ofPixel), 2u);
        // One number for all: who sees the coarser level of an instance sees that of all that are farther on their way.
        EXPECT_TRUE(!seesCoarser(w, EIGHTH, ofPixel) || seesCoarser(w, HALF, ofPixel));
        EXPECT_TRUE(!seesCoarser(w, HALF, ofPixel) || seesCoarser(w, MOST, ofPixel));
        // Numbers of their own: independent.
        if (seesCoarser(w, EACH_A, ofPixel) && seesCoarser(w, EACH_B, ofPixel)) atomicAdd(sums.at[2u * COUNT], 1u);
        if (seesCoarser(w, EACH_A, ofPixel) && seesCoarser(w, HALF, ofPixel)) atomicAdd(sums.at[2u * COUNT + 1u], 1u);
        // Another frame, another number; none where nothing dissolves.
        World next = w;
        next.frameKey = 6u;
        if (seesCoarser(w, HALF, ofPixel) && seesCoarser(next, HALF, numberOfPixel(next, pixel))) atomicAdd(sums.at[2u * COUNT + 2u], 1u);
        next.dissolves = UintArray(0ul);
        EXPECT_EQ(levelSeen(next, MOST, 0u), 2u);
        return;
    }
    if (i != 0u) return;
    float shares[COUNT] = float[](0.0, 0.125, 0.5, 0.875, 1.0 / 3.0, 0.5, 0.5);
    for (uint k = 0u; k < 2u * COUNT; ++k) {
        float share = shares[k % COUNT];
        EXPECT_NEAR(float(sums.at[k]) / float(all), share, 4.0 * sqrt(share * (1.0 - share) / float(all)));
    }
    for (uint k = 0u; k < 3u; ++k) EXPECT_NEAR(float(sums.at[2u * COUNT + k]) / float(all), 0.25, 4.0 * sqrt(0.1875 / float(all)));
}
