// SPDX-License-Identifier: MIT
// If this failed, images would change by being stored, or a texel's store would damage its neighbour.
// groups: 1
// passes: 2
#version 460
#include "base/test.glsl"
#include "base/texel.glsl"

layout(local_size_x = 64) in;

void main() {
    uint i = gl_GlobalInvocationID.x;
    // Every lane stores a half of its own; two share each word.
    uint64_t memory = testPush.results + uint64_t(16u + 48u * TEST_RECORDS);  // of testScratch
    if (testPush.pass == 0u) {
        OutR16f(memory).at[i] = encodeR16f(float(i) * 0.25);
        return;
    }
    EXPECT_EQ(decodeR16f(InR16f(memory).at[i]), float(i) * 0.25);
    if (i != 0u) return;

    // Known encodings: 1.0h = 0x3c00, -2.0h = 0xc000, 0.5h = 0x3800.
    EXPECT_EQ(uint(encodeR16f(1.0)), 0x3c00u);
    EXPECT_EQ(encodeRg16f(vec2(1.0, -2.0)), 0xc0003c00u);
    EXPECT_EQ(encodeRgba16f(vec4(1.0, -2.0, 0.5, 0.0)).x, 0xc0003c00u);
    EXPECT_EQ(encodeRgba16f(vec4(1.0, -2.0, 0.5, 0.0)).y, 0x00003800u);
    EXPECT_EQ(encodeRgba8(vec4(0.0, 1.0, 0.5, 2.0)), 0xff80ff00u);

    // What has an encoding survives the round trip; the rest is off by half a step at most.
    vec4 value = vec4(0.0009765625, -1.5, 1000.0, 65504.0);
    vec4 back = decodeRgba16f(encodeRgba16f(value));
    for (int c = 0; c < 4; ++c) EXPECT_EQ(back[c], value[c]);
    EXPECT_EQ(decodeRg16f(encodeRg16f(value.xy)).y, value.y);
    vec4 bytes = decodeRgba8(encodeRgba8(vec4(0.1, 0.2, 0.7, 0.9)));
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(bytes[c], vec4(0.1, 0.2, 0.7, 0.9)[c], 0.5 / 255.0 + 1e-6);
    EXPECT_EQ(decodeR32ui(encodeR32ui(0xfedcba98u)), 0xfedcba98u);
    EXPECT_EQ(decodeRg32f(encodeRg32f(vec2(0.1, 0.2))).y, 0.2);
    EXPECT_EQ(decodeRgba32f(encodeRgba32f(vec4(0.1))).w, 0.1);

    EXPECT_EQ(asRgba(0.25).b, 0.25);
    EXPECT_EQ(asRgba(vec2(1.0, 2.0)).a, 1.0);
    EXPECT_EQ(texelIndex(ivec2(3, 2), uvec2(10, 5)), 23u);
}
