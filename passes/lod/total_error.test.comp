// SPDX-License-Identifier: MIT
// If these fail, a budget goes into triangles that noise hides, or into samples of a model that is seen to be coarse.
// groups: 16
// passes: 2
#version 460
#include "base/random.glsl"
#include "lod/total_error.glsl"
#include "lod/test_levels.glsl"
layout(local_size_x = 64) in;

uint chosen(World w, uint instance, float samples) { return levelByTotalError(w, instance, TotalError(0.1, samples, 0.04), false, 0u, 0.2); }

void main() {
    if (testPush.pass == 0u) {
        if (gl_GlobalInvocationID.x == 0u) writeLevels();
        return;
    }
    World w = levelsWorld();

    EXPECT_NEAR(geometryError(0.5), 0.25, 1e-7);
    EXPECT_NEAR(geometryError(1.0), 1.0, 1e-7);
    EXPECT_NEAR(geometryError(3.0), 3.0, 1e-7);

    // Geometry makes 0, 0.004, 0.064 and 0.32 of the variance of a path; four times the triangles cost 0.08 of a path, which is 0.08 / samples of noise.
    EXPECT_EQ(chosen(w, FAR_ONE, 0.1), 3u);
    EXPECT_EQ(chosen(w, FAR_ONE, 1.0), 2u);   // 0.24 + 0, 0.16 + 0.004, 0.08 + 0.064, 0 + 0.32
    EXPECT_EQ(chosen(w, FAR_ONE, 4.0), 1u);   // 0.06 + 0, 0.04 + 0.004, 0.02 + 0.064
    EXPECT_EQ(chosen(w, FAR_ONE, 19.0), 1u);  // 0.08 / 19 is above 0.004, 0.08 / 21 is not
    EXPECT_EQ(chosen(w, FAR_ONE, 21.0), 0u);
    EXPECT_EQ(chosen(w, PINNED, 0.1), 0u);
    EXPECT_EQ(chosen(w, AROUND, 0.1), 0u);
    // Nothing is gained by triangles that cost nothing, nor by coarse ones where errors don't count.
    EXPECT_EQ(levelByTotalError(w, FAR_ONE, TotalError(0.1, 1.0, 0.0), false, 0u, 0.0), 0u);
    EXPECT_EQ(levelByTotalError(w, FAR_ONE, TotalError(0.0, 1.0, 0.04), false, 0u, 0.0), 3u);

    // With one sample level 2 wins 0.02 over level 1, a quarter of what the noise between them is.
    TotalError one = TotalError(0.1, 1.0, 0.04);
    EXPECT_EQ(levelByTotalError(w, FAR_ONE, one, true, 1u, 0.2), 2u);
    EXPECT_EQ(levelByTotalError(w, FAR_ONE, one, true, 1u, 0.3), 1u);
    EXPECT_EQ(levelByTotalError(w, FAR_ONE, one, true, 0u, 0.3), 2u);  // 0.096 of 0.16
    EXPECT_EQ(levelByTotalError(w, FAR_ONE, one, true, 7u, 0.9), 2u);  // no such level any more
    EXPECT_EQ(levelByTotalError(w, FAR_ONE, one, false, 1u, 0.9), 2u);

    // The more samples, the finer; and what is chosen anew with what was chosen before stays.
    vec2 u = random2(pathSeed(uvec2(gl_GlobalInvocationID.x, 0), 0u, 3u), 0u, 0u);
    float samples = exp2(12.0 * u.x - 4.0);
    EXPECT_TRUE(chosen(w, FAR_ONE, 2.0 * samples) <= chosen(w, FAR_ONE, samples));
    for (uint last = 0u; last < 4u; ++last) {
        TotalError e = TotalError(0.1, samples, 0.04);
        uint now = levelByTotalError(w, FAR_ONE, e, true, last, 0.9 * u.y);
        EXPECT_EQ(levelByTotalError(w, FAR_ONE, e, true, now, 0.9 * u.y), now);
    }
}
