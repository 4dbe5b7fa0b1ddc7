// SPDX-License-Identifier: MIT
// If these fail, paths go where they are not needed: guides leave their range, or grow the wrong way.
// groups: 1
#version 460
#include "base/test.glsl"
#include "rate/need.glsl"
layout(local_size_x = 64) in;

void main() {
    float x = float(gl_GlobalInvocationID.x) / 63.0, more = x + 1.0 / 63.0, zero = testFloats[1];  // 0, which compilers don't know
    EXPECT_NEAR(noiseNeed(0.25, 1.0, 0.0), 0.5, 1e-6);
    EXPECT_NEAR(noiseNeed(0.25, 0.5, 10.0), 0.5, 1e-6);
    EXPECT_EQ(noiseNeed(100.0, 1.0, 1.0), 1.0);
    EXPECT_EQ(noiseNeed(zero, zero, zero), 0.0);
    EXPECT_EQ(noiseNeed(-x, 1.0, 1.0), 0.0);  // moments of equal numbers, rounded
    EXPECT_TRUE(noiseNeed(x, 1.0, 1.0) <= noiseNeed(more, 1.0, 1.0));
    EXPECT_EQ(vec2(confidenceNeed(zero, 20.0), confidenceNeed(25.0, 20.0)), vec2(1.0, 0.0));
    EXPECT_NEAR(confidenceNeed(5.0, 20.0), 0.75, 1e-6);
    EXPECT_EQ(confidenceNeed(1.0, zero), 1.0);
    EXPECT_EQ(vec2(copiesNeed(zero), copiesNeed(1.0)), vec2(0.0, 1.0));
    EXPECT_NEAR(copiesNeed(0.25), 0.5, 1e-6);
    EXPECT_EQ(vec3(specularNeed(zero), specularNeed(0.05), specularNeed(0.35)), vec3(1.0, 1.0, 0.0));
    EXPECT_TRUE(specularNeed(x) >= specularNeed(more));
    EXPECT_EQ(vec3(nearnessNeed(zero, 2.0), nearnessNeed(2.0, 2.0), nearnessNeed(1e30, 2.0)), vec3(1.0, 0.0, 0.0));
    EXPECT_EQ(nearnessNeed(1.0, zero), 0.0);
}
