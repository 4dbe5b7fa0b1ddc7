// SPDX-License-Identifier: MIT
// Must fail: every kind of check, with values that the runner has to print.
// groups: 2
#version 460
#include "base/test.glsl"
layout(local_size_x = 4) in;

float divide(float a, float b) { return a / b; }

void main() {
    EXPECT_TRUE(gl_GlobalInvocationID.x < 7u);
    if (gl_GlobalInvocationID.x > 0u) return;
    EXPECT_NEAR(0.52, 0.5, 0.01);
    EXPECT_EQ(-3, 4);
    EXPECT_EQ(uint64_t(1) << 40, uint64_t(2));
    EXPECT_NEAR(vec3(1, 2, 3), vec3(1, 2, 4), 0.5);
    EXPECT_NEAR(divide(testFloats[0], testFloats[1]), 0.0, 1.0);
    EXPECT_EQ(0.1, 0.3);
}
