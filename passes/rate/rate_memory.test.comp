// SPDX-License-Identifier: MIT
// If these fail, a pixel's rates of earlier frames are not what they were: edges that one frame misses are traced coarsely.
// groups: 4
#version 460
#include "base/test.glsl"
#include "rate/rate_memory.glsl"
layout(local_size_x = 64) in;

void main() {
    uint rates = gl_GlobalInvocationID.x;  // each of the 256
    uint slots[4];
    for (uint i = 0u; i < 4u; ++i) slots[i] = rates >> 2u * i & 3u;
    for (uint count = 1u; count <= 4u; ++count) {
        bool halfX = true, halfY = true;
        for (uint i = 0u; i < count; ++i) {
            halfX = halfX && (slots[i] & RATE_HALF_X) != 0u;
            halfY = halfY && (slots[i] & RATE_HALF_Y) != 0u;
        }
        EXPECT_EQ(finestRate(rates, count), (halfX ? RATE_HALF_X : 0u) | (halfY ? RATE_HALF_Y : 0u));
    }
    for (uint rate = 0u; rate < 4u; ++rate) {
        uint pushed = pushRate(rates, rate);
        EXPECT_EQ(pushed & 3u, rate);
        for (uint i = 1u; i < 4u; ++i) EXPECT_EQ(pushed >> 2u * i & 3u, slots[i - 1u]);
        EXPECT_TRUE(pushed < 256u);
        EXPECT_EQ(finestRate(pushed, 1u), rate);
    }
    RateMemory m = RateMemory(0.0, 0.0, 0.0, packMemory(rates, 255u - rates, rates ^ 85u));
    EXPECT_EQ(uvec3(ratesOf(m), ageOf(m), framesOf(m)), uvec3(rates, 255u - rates, rates ^ 85u));
    m.packed = packMemory(rates, 256u + rates, 1000u);
    EXPECT_EQ(uvec3(ratesOf(m), ageOf(m), framesOf(m)), uvec3(rates, 255u, 255u));
    EXPECT_EQ(finestRate(0u, 4u), RATE_FULL);  // cleared memory: nothing is known, so everything is traced
    EXPECT_EQ(finestRate(0xffu, 4u), RATE_QUARTER);
    // One frame of full rate lasts for four.
    uint after = pushRate(0xffu, RATE_FULL);
    for (uint frame = 1u; frame < 4u; ++frame, after = pushRate(after, RATE_QUARTER)) EXPECT_EQ(finestRate(after, 4u), RATE_FULL);
    EXPECT_EQ(finestRate(pushRate(after, RATE_QUARTER), 4u), RATE_QUARTER);
}
