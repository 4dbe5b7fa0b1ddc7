// SPDX-License-Identifier: MIT
// If these fail, levels dissolve at other depths than were asked for, jump where they should pass, or are levels that a mesh doesn't have.
// groups: 64
// passes: 2
#version 460
#include "base/random.glsl"
#include "lod/depth_level.glsl"
#include "lod/test_levels.glsl"
layout(local_size_x = 64) in;

uvec2 pair(LevelShare s) { return uvec2(s.level, s.coarser); }

// The next coarser level's share, all in all: level + share.
float shown(float l, uint levels, float transition, uint steps) {
    LevelShare s = levelShare(l, levels, transition, steps);
    EXPECT_TRUE(s.coarser < steps);
    EXPECT_TRUE(s.level < levels);
    EXPECT_TRUE(s.coarser == 0u || s.level + 1u < levels);
    return float(s.level) + float(s.coarser) / float(steps);
}

void main() {
    if (testPush.pass == 0u) {
        if (gl_GlobalInvocationID.x == 0u) writeLevels();
        return;
    }
    World w = levelsWorld();
    // Depth is along the view: the sphere's middle lies 12 away; its mesh has 4 levels.
    EXPECT_NEAR(levelByDepth(w, FAR_ONE, DepthCurve(false, 4.0, 20.0, 0.0)), 2.0, 1e-5);
    EXPECT_NEAR(levelByDepth(w, FAR_ONE, DepthCurve(false, 4.0, 20.0, -0.5)), 1.5, 1e-5);
    EXPECT_NEAR(levelByDepth(w, FAR_ONE, DepthCurve(true, 3.0, 48.0, 0.0)), 2.0, 1e-5);
    EXPECT_NEAR(levelByDepth(w, FAR_ONE, DepthCurve(true, 12.0, 48.0, 0.0)), 0.0, 1e-5);
    EXPECT_TRUE(levelByDepth(w, AROUND, DepthCurve(true, 3.0, 48.0, 0.0)) < 0.0);
    World aside = w;  // the same depth, but farther away
    aside.camera.position = vec3(50, 0, 0);
    EXPECT_NEAR(levelByDepth(aside, FAR_ONE, DepthCurve(false, 4.0, 20.0, 0.0)), 2.0, 1e-5);

    // t = 1: eight steps over the whole way, nine states that last alike.
    for (uint k = 0u; k <= 8u; ++k) EXPECT_NEAR(shown(1.0 + (float(k) + 0.5) / 9.0, 4u, 1.0, 8u), 1.0 + float(k) / 8.0, 1e-6);
    // t = 1/2: nothing before a quarter and after three.
    EXPECT_EQ(levelShare(1.24, 4u, 0.5, 8u).coarser, 0u);
    EXPECT_EQ(pair(levelShare(1.5, 4u, 0.5, 8u)), uvec2(1u, 4u));
    EXPECT_EQ(pair(levelShare(1.76, 4u, 0.5, 8u)), uvec2(2u, 0u));
    // t = 0: a switch half way. The finest, the coarsest and meshes of one level are always whole.
    EXPECT_EQ(pair(levelShare(1.49, 4u, 0.0, 8u)), uvec2(1u, 0u));
    EXPECT_EQ(pair(levelShare(1.5, 4u, 0.0, 8u)), uvec2(2u, 0u));
    EXPECT_EQ(pair(levelShare(-3.0, 4u, 1.0, 8u)), uvec2(0u, 0u));
    EXPECT_EQ(pair(levelShare(9.0, 4u, 1.0, 8u)), uvec2(3u, 0u));
    EXPECT_EQ(pair(levelShare(0.5, 1u, 1.0, 8u)), uvec2(0u, 0u));

    // Never finer farther away, never more than a step and half off the line, for any steps.
    vec3 u = random3(pathSeed(uvec2(gl_GlobalInvocationID.x, 0), 0u, 3u), 0u, 0u);
    uint steps = 1u + uint(u.z * 20.0);
    float l = 3.0 * u.x, t = u.y, here = shown(l, 4u, t, steps);
    EXPECT_TRUE(shown(l + 0.01, 4u, t, steps) >= here);
    if (l >= 0.5 && l <= 2.5) EXPECT_TRUE(abs(shown(l, 4u, 1.0, steps) - l) <= 1.0 / float(steps + 1u) + 1e-5);

    // As the World holds it: eighths are exact, and leave bits 8 to 28 free.
    for (uint k = 1u; k < 8u; ++k) EXPECT_EQ(dissolveOf(LevelShare(0u, k), 8u, false), k << 29);
    EXPECT_EQ(dissolveOf(LevelShare(0u, 0u), 8u, true), 0u);
    EXPECT_EQ(dissolveOf(LevelShare(0u, 1u), 2u, true), 0x80000000u | DISSOLVE_EACH);
}
