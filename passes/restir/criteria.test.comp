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

// Both ways by hand: at distance 2 with densities 4 and 1 / 2, under cosines 1 / 4 (at x_{j-1}) and 1 / 2 (at x_j) the footprints are
// 4 / (4 / 2) = 2 and 4 / (1 / 2 / 4) = 32.
void testFootprint() {
    Pair p = Pair(PAIR_SURFACE, 0.5, 0.01, 4.0, 0.5, 0.25, 0.5, 2.0), back = p;
    EXPECT_EQ(connectable(ConnectionCriteria(CRITERIA_FOOTPRINT, 0.2, 1.99), p), true);  // whatever the roughness at x_j
    EXPECT_EQ(connectable(ConnectionCriteria(CRITERIA_FOOTPRINT, 0.2, 2.01), p), false);
    EXPECT_EQ(connectable(ConnectionCriteria(CRITERIA_FOOTPRINT, 0.6, 1.0), p), false);
    ConnectionCriteria c = ConnectionCriteria(CRITERIA_FOOTPRINT, 0.2, 1.5);
    back.pdfAt = 16.0;  // 4 / (16 / 4) = 1
    EXPECT_EQ(connectable(c, back), false);
    back.end = PAIR_REACHED;  // what leaves x_j isn't known yet
    EXPECT_EQ(connectable(c, back), true);
    back.end = PAIR_EMITTER;  // 4 / (1 / 2 pi / 4) = 100.5
    EXPECT_EQ(connectable(ConnectionCriteria(CRITERIA_FOOTPRINT, 0.2, 1.99), back), true);
    back.end = PAIR_ENVIRONMENT;
    EXPECT_EQ(connectable(ConnectionCriteria(CRITERIA_FOOTPRINT, 0.2, 1e9), back), true);
    back = p;
    back.at = 0.0;  // a delta lobe
    EXPECT_EQ(connectable(c, back), false);
    back = p;
    back.pdfBefore = 0.0;
    EXPECT_EQ(connectable(c, back), false);
    EXPECT_NEAR(primaryFootprint(3.0, 0.5), 4.0 * PI * 18.0, 1e-3);

    // The threshold's mean and deviation, and that the path tells it.
    float sum = 0.0, squares = 0.0;
    for (uint i = 0u; i < 4096u; ++i) {
        float t = pathThreshold(uvec2(i, 7), 0.2) - 1.0;
        sum += t;
        squares += t * t;
    }
    EXPECT_NEAR(sum / 4096.0, 0.0, 0.2 / 64.0 * 4.0);
    EXPECT_NEAR(sqrt(squares / 4096.0), 0.2, 0.01);
    EXPECT_EQ(pathThreshold(uvec2(5, 7), 0.2), pathThreshold(uvec2(5, 7), 0.2));
    EXPECT_EQ(pathThreshold(uvec2(5, 7), 0.0), 1.0);
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    ConnectionCriteria c = ConnectionCriteria(CRITERIA_DISTANCE, 0.2, 0.1);
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
    ConnectionCriteria all = ConnectionCriteria(CRITERIA_DISTANCE, 0.0, 0.0);  // only delta lobes are left out
    EXPECT_EQ(connectable(all, surfacePair(1e-3, 1e-3, 0.0)), true);
    EXPECT_EQ(connectable(all, surfacePair(0.0, 1.0, 1.0)), false);
    EXPECT_EQ(connectable(all, surfacePair(1.0, 0.0, 1.0)), false);
    EXPECT_EQ(connectable(all, lightPair(PAIR_ENVIRONMENT, 0.0, 0.0)), false);
    testFootprint();
}
