// SPDX-License-Identifier: MIT
// If these fail, blocks do not hold what BC4 says, or are made worse than their bits allow.
// groups: 64
#version 460
#include "base/test.glsl"
#include "base/math.glsl"
#include "impostor/bc4_encode.glsl"
layout(local_size_x = 64) in;

const uint ALL = 0xffffu;

/// Largest difference between the values that count and what the block gives for them.
float worst(float values[16], uint counted, uvec2 block) {
    float most = 0.0;
    for (uint i = 0u; i < 16u; ++i)
        if ((counted >> i & 1u) != 0u) most = max(most, abs(bc4Decode(block, i) - values[i]));
    return most;
}

// A draw in [0, 1) for each invocation and place.
float draw(uint id, uint i) { return fract(0.7548776662 * float(id % 4096u) + 0.5698402910 * float(i) + 0.37 * float(i * i % 7u)); }

void testDecoding() {
    // Texel i has code i % 8: from bit 16 on 24 bits that repeat once. Octal 76543210.
    const uint codes = 0xfac688u;
    uvec2 tail = uvec2(codes << 16, codes >> 16 | codes << 8);
    const float eight[8] = float[8](1.0, 0.0, 6.0 / 7.0, 5.0 / 7.0, 4.0 / 7.0, 3.0 / 7.0, 2.0 / 7.0, 1.0 / 7.0);
    const float six[8] = float[8](51.0 / 255.0, 204.0 / 255.0, 0.32, 0.44, 0.56, 0.68, 0.0, 1.0);
    for (uint i = 0u; i < 16u; ++i) {
        EXPECT_NEAR(bc4Decode(tail | uvec2(0x00ffu, 0u), i), eight[i % 8u], 1e-6);
        EXPECT_NEAR(bc4Decode(tail | uvec2(0xcc33u, 0u), i), six[i % 8u], 1e-6);
    }
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    testDecoding();
    float values[16];

    // What 8 bits hold comes back as it was: one value, and two.
    for (uint i = 0u; i < 16u; ++i) values[i] = float(id % 256u) / 255.0;
    EXPECT_NEAR(worst(values, ALL, bc4Encode(values, ALL, true)), 0.0, 1e-6);
    for (uint i = 0u; i < 16u; ++i) values[i] = float(i * 7u % 3u == 0u ? id % 256u : id * 37u % 256u) / 255.0;
    EXPECT_NEAR(worst(values, ALL, bc4Encode(values, ALL, true)), 0.0, 1e-6);

    // One that 8 bits don't hold lies on a step between two neighbours, of which there are 7.
    for (uint i = 0u; i < 16u; ++i) values[i] = float(id) / 4095.0;
    EXPECT_TRUE(worst(values, ALL, bc4Encode(values, ALL, false)) <= 0.5 / (7.0 * 255.0) + 1e-6);

    // Eight evenly spaced values are those of a block.
    uint low = id % 16u, high = low + 7u * (1u + id / 16u % 32u);
    for (uint i = 0u; i < 16u; ++i) values[i] = mix(float(low), float(high), float(i % 8u) / 7.0) / 255.0;
    EXPECT_NEAR(worst(values, ALL, bc4Encode(values, ALL, false)), 0.0, 1e-6);

    // No value is off by more than half a step, the step being what the outward rounding of end points makes it at most: least squares may trade
    // one texel for the others, but the sum stays below.
    float range = 0.05 + 0.9 * draw(id, 40u), base = (1.0 - range) * draw(id, 41u), sum = 0.0;
    for (uint i = 0u; i < 16u; ++i) values[i] = base + range * draw(id, i);
    uvec2 block = bc4Encode(values, ALL, false);
    for (uint i = 0u; i < 16u; ++i) sum += square(bc4Decode(block, i) - values[i]);
    EXPECT_TRUE(sum <= 16.0 * square(0.5 * (range + 2.0 / 255.0) / 7.0));

    // What doesn't count has no part in it.
    uint counted = uint(draw(id, 50u) * 65536.0), some = 0u;
    for (uint i = 0u; i < 16u; ++i) {
        bool counts = (counted >> i & 1u) != 0u;
        values[i] = counts ? 0.25 : draw(id, i);
    }
    EXPECT_TRUE(worst(values, counted, bc4Encode(values, counted, false)) <= 0.5 / (7.0 * 255.0) + 1e-6);
    EXPECT_EQ(bc4Encode(values, 0u, true), uvec2(0u));

    // Zero stays zero, and nothing becomes it, however small it is beside the others; all or nothing stay what they are, too, where quarters don't.
    for (uint i = 0u; i < 16u; ++i) values[i] = draw(id, i) < 0.4 ? 0.0 : draw(id, i) < 0.6 ? 1.0 / 255.0 : draw(id, i + 16u) * 254.0 / 255.0 + 1.0 / 255.0;
    block = bc4Encode(values, ALL, true);
    for (uint i = 0u; i < 16u; ++i) EXPECT_EQ(bc4Decode(block, i) > 0.0, values[i] > 0.0);
    for (uint i = 0u; i < 16u; ++i) values[i] = i < 4u ? 0.0 : i < 8u ? 1.0 : 0.25 * floor(1.0 + 3.0 * draw(id, i));
    block = bc4Encode(values, ALL, true);
    for (uint i = 0u; i < 16u; ++i) EXPECT_EQ(bc4Decode(block, i) > 0.0, values[i] > 0.0);
    EXPECT_TRUE(worst(values, ALL, block) <= 0.08);
}
