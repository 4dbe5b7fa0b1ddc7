// SPDX-License-Identifier: MIT
// If these fail, frames are skewed or NaN enters images through vectors without direction.
// groups: 16
#version 460
#include "base/math.glsl"
#include "base/random.glsl"
#include "base/test.glsl"
layout(local_size_x = 64) in;

void main() {
    uint id = gl_GlobalInvocationID.x;
    vec3 u = random3(uvec2(id, 0), 0u, 0u) * 2.0 - 1.0;
    vec3 n = safeNormalize(id == 0u ? vec3(0, 0, -1) : id == 1u ? vec3(1e-4, 0, -1) : u, vec3(0, 0, 1));
    EXPECT_NEAR(length(n), 1.0, 5e-7);
    mat3 basis = basisAround(n);
    EXPECT_NEAR(transpose(basis) * basis * u, u, 2e-6);  // orthonormal
    EXPECT_NEAR(cross(basis[0], basis[1]), n, 1e-6);      // right-handed
    EXPECT_NEAR(safeNormalize(u * 1e-20, vec3(0)), normalize(u), 1e-6);  // its square is zero
    EXPECT_NEAR(safeNormalize(u * 1e25, vec3(0)), normalize(u), 1e-6);
    if (id > 0u) return;
    float zero = uintBitsToFloat(testPush.pass);  // not known to the compiler
    vec3 otherwise = vec3(0, 1, 0);
    EXPECT_EQ(safeNormalize(vec3(zero), otherwise), otherwise);
    EXPECT_EQ(safeNormalize(vec3(1.0 / zero, 1, 2), otherwise), otherwise);
    EXPECT_EQ(safeNormalize(vec3(zero / zero, 1, 2), otherwise), otherwise);
    EXPECT_TRUE(!finite3(vec3(zero / zero, 1, 2)));
    EXPECT_TRUE(!finite3(vec3(1, 2, 1.0 / zero)));
    EXPECT_TRUE(finite3(vec3(1, 2, 3)));
    EXPECT_NEAR(luminance(vec3(1)), 1.0, 1e-6);
    EXPECT_NEAR(luminance(vec3(0, 1, 0)), 0.7152, 1e-6);
}
