// SPDX-License-Identifier: MIT
// If these fail, base and shifted paths reconnect at different vertices: light near the thresholds is counted twice or not at all.
// groups: 64
#version 460
#include "base/random.glsl"
#include "base/test.glsl"
#include "restir/criteria.glsl"
layout(local_size_x = 64) in;

const uint VERTICES = 8u;  // x_1 .. x_8; x_8 is an emitter

Pair surfacePair(float before, float at, float distance) { return Pair(PAIR_SURFACE, before, at, 0.0, 0.0, 1.0, 1.0, distance); }
Pair lightPair(uint end, float before, float distance) { return Pair(end, before, 0.0, 0.0, 0.0, 1.0, 1.0, distance); }

void main() {
    uint id = gl_GlobalInvocationID.x;
    ConnectionCriteria c = ConnectionCriteria(0.2, 0.1);
    const float least = 818.5 / 4096.0;  // of the step that 0.2 lies in
    // k against its definition: the least j whose pair is rough at both ends and far enough apart.
    float roughness[VERTICES + 1u], distance[VERTICES + 1u];
    for (uint j = 1u; j <= VERTICES; ++j) {
        vec2 u = random2(uvec2(id, 3), j, 0u);
        roughness[j] = u.x < 0.3 ? 0.0 : u.x * u.x;
        distance[j] = u.y * 0.3;
    }
    uint k = 0u, expected = 0u;
    for (uint j = 2u; j <= VERTICES && k == 0u; ++j) {
        Pair pair = j < VERTICES ? surfacePair(roughness[j - 1u], roughness[j], distance[j]) : lightPair(PAIR_EMITTER, roughness[j - 1u], distance[j]);
        if (connectable(c, pair)) k = j;
    }
    for (uint j = VERTICES; j >= 2u; --j)
        if (roughness[j - 1u] >= least && distance[j] >= 0.1 && (roughness[j] >= least || j == VERTICES)) expected = j;
    EXPECT_EQ(k, expected);
    if (id > 0u) return;
    EXPECT_EQ(connectable(c, surfacePair(0.2, 0.2, 0.1)), true);  // the thresholds themselves are in
    EXPECT_EQ(connectable(c, surfacePair(0.19999999, 0.2, 0.1)), true);  // however they were rounded
    EXPECT_EQ(connectable(c, surfacePair(0.19, 1.0, 5.0)), false);
    EXPECT_EQ(connectable(c, surfacePair(1.0, 0.19, 5.0)), false);
    EXPECT_EQ(connectable(c, surfacePair(1.0, 1.0, 0.09)), false);
    EXPECT_EQ(connectable(c, lightPair(PAIR_EMITTER, 0.2, 0.1)), true);
    EXPECT_EQ(connectable(c, lightPair(PAIR_EMITTER, 0.2, 0.09)), false);
    EXPECT_EQ(connectable(c, lightPair(PAIR_EMITTER, 0.1, 1.0)), false);
    EXPECT_EQ(connectable(c, lightPair(PAIR_LIGHT, 0.2, 0.1)), true);
    EXPECT_EQ(connectable(c, lightPair(PAIR_LIGHT, 0.1, 1.0)), false);
    EXPECT_EQ(connectable(c, lightPair(PAIR_ENVIRONMENT, 0.2, 0.0)), true);
    EXPECT_EQ(connectable(c, lightPair(PAIR_ENVIRONMENT, 0.1, 0.0)), false);
    ConnectionCriteria all = ConnectionCriteria(0.0, 0.0);  // only delta lobes are left out
    EXPECT_EQ(connectable(all, surfacePair(1e-3, 1e-3, 0.0)), true);
    EXPECT_EQ(connectable(all, surfacePair(0.0, 1.0, 1.0)), false);
    EXPECT_EQ(connectable(all, surfacePair(1.0, 0.0, 1.0)), false);
    EXPECT_EQ(connectable(all, lightPair(PAIR_ENVIRONMENT, 0.0, 0.0)), false);
}
