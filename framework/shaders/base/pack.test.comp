// SPDX-License-Identifier: MIT
// If these fail, normals that the CPU packed point elsewhere on the GPU. tests/cpu/pack_test.cpp has the same known answers.
// groups: 64
#version 460
#include "base/pack.glsl"
#include "base/random.glsl"
#include "base/test.glsl"
layout(local_size_x = 64) in;

void main() {
    uint id = gl_GlobalInvocationID.x;
    vec3 n = safeNormalize(random3(uvec2(id, 1), 0u, 0u) * 2.0 - 1.0, vec3(0, 0, 1));
    // Half a step of 1 / 32767 on each coordinate, a whole one for a tangent, stretched up to 4 times by the map.
    EXPECT_NEAR(unpackNormal(packNormal(n)), n, 7e-5);
    EXPECT_NEAR(length(unpackNormal(packNormal(n))), 1.0, 5e-7);
    vec3 packed = unpackNormal(packNormal(n));
    EXPECT_NEAR(unpackNormal(packNormal(packed)), packed, 1e-6);  // once packed it stays
    // A direction that is stored with a path: near, and exactly the same direction when packed again, or a path would not be what is stored of it.
    for (uint i = 0u; i < 64u; ++i) {
        vec3 d = safeNormalize(random3(uvec2(id, i), 1u, 0u) * 2.0 - 1.0, vec3(0, 0, 1));
        if ((i & 1u) == 1u) d = safeNormalize(d * vec3(1.0, 1e-6, 1.0), vec3(0, 0, -1));  // along the folds of the map
        uvec2 bits = packDirection(d);
        EXPECT_NEAR(unpackDirection(bits), d, 4.5e-6);
        EXPECT_EQ(unpackDirection(packDirection(unpackDirection(bits))), unpackDirection(bits));
    }
    float sign = (id & 1u) == 0u ? 1.0 : -1.0;
    EXPECT_NEAR(unpackTangent(packTangent(vec4(n, sign))), vec4(n, sign), 1.4e-4);
    if (id > 0u) return;
    EXPECT_EQ(packNormal(vec3(0, 0, 1)), 0u);
    EXPECT_EQ(packDirection(vec3(0, -1, 0)).xyy, uvec2(0u, uint(-524287)).xyy);
    EXPECT_EQ(packNormal(vec3(1, 0, 0)), 0x00007fffu);
    EXPECT_EQ(packNormal(vec3(-1, 0, 0)), 0x00008001u);
    EXPECT_EQ(packNormal(vec3(0, 1, 0)), 0x7fff0000u);
    EXPECT_EQ(packNormal(vec3(0, 0, -1)), 0x7fff7fffu);
    EXPECT_EQ(packNormal(vec3(1, -2, 2) / 3.0), 0xcccd1999u);
    EXPECT_EQ(packNormal(vec3(-2, 1, -2) / 3.0), 0x4ccc999au);
    EXPECT_EQ(unpackNormal(0x7fff7fffu), vec3(0, 0, -1));
    EXPECT_EQ(packTangent(vec4(0, 0, 1, 1)), 0x00010000u);
    EXPECT_EQ(packTangent(vec4(0, 0, 1, -1)), 1u);
    EXPECT_EQ(packTangent(vec4(1, 0, 0, 1)), 0x00007ffeu);
    EXPECT_EQ(packTangent(vec4(1, 0, 0, -1)), 0x00007fffu);
    EXPECT_EQ(unpackColor(uvec2(0x00003c00u, 0x38002e66u)), vec4(1.0, 0.0, 0.0999755859375, 0.5));
    EXPECT_EQ(packColor(vec4(0.001, 131.0 / 65535.0, 7.0, 1.0)), uvec2(0x18181419u, 0x3c004700u));
}
