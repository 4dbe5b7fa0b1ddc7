// SPDX-License-Identifier: MIT
// If these fail, objects are shown at levels whose errors are seen, or at finer ones than anybody could see, or flicker between two.
// groups: 16
// passes: 2
#version 460
#include "base/random.glsl"
#include "lod/screen_error.glsl"
#include "lod/test_levels.glsl"
layout(local_size_x = 64) in;

void main() {
    if (testPush.pass == 0u) {
        if (gl_GlobalInvocationID.x == 0u) writeLevels();
        return;
    }
    World w = levelsWorld();

    InstanceView far = instanceView(w, FAR_ONE);
    EXPECT_NEAR(far.distance, 10.0, 1e-5);
    EXPECT_NEAR(far.radius, 2.0, 1e-6);
    EXPECT_NEAR(screenError(w, FAR_ONE, far, 1u), 0.2, 1e-6);
    EXPECT_NEAR(screenError(w, FAR_ONE, far, 3u), 3.2, 1e-5);
    EXPECT_NEAR(screenError(w, FLATTENED, instanceView(w, FLATTENED), 3u), 3.2, 1e-5);

    // To an orthographic camera an error is as many pixels wherever it is.
    World o = w;
    o.camera.orthographic = 1u;
    EXPECT_NEAR(screenError(o, FAR_ONE, far, 1u), 2.0, 1e-5);
    EXPECT_NEAR(screenError(o, AROUND, instanceView(o, AROUND), 1u), 1.0, 1e-5);

    // The coarsest level within the limit.
    EXPECT_EQ(levelByError(w, FAR_ONE, 0.1, false, 0u, 0.0), 0u);
    EXPECT_EQ(levelByError(w, FAR_ONE, 0.5, false, 0u, 0.0), 1u);
    EXPECT_EQ(levelByError(w, FAR_ONE, 1.0, false, 0u, 0.0), 2u);
    EXPECT_EQ(levelByError(w, FAR_ONE, 4.0, false, 0u, 0.0), 3u);
    EXPECT_EQ(levelByError(w, PINNED, 4.0, false, 0u, 0.0), 0u);
    EXPECT_EQ(levelByError(w, AROUND, 1000.0, false, 0u, 0.0), 0u);
    // Hysteresis asks more of a coarser level than was shown, and nothing more of the one that was.
    EXPECT_EQ(levelByError(w, FAR_ONE, 1.0, true, 1u, 0.3), 1u);
    EXPECT_EQ(levelByError(w, FAR_ONE, 1.0, true, 2u, 0.3), 2u);
    EXPECT_EQ(levelByError(w, FAR_ONE, 1.0, true, 3u, 0.3), 2u);
    EXPECT_EQ(levelByError(w, FAR_ONE, 1.0, false, 1u, 0.3), 2u);

    // By distance: level 0 up to 2.5 radii, which is 5, level 1 up to 10.
    EXPECT_EQ(levelByDistance(w, FAR_ONE, 2.6, false, 0u, 0.0), 1u);
    EXPECT_EQ(levelByDistance(w, FAR_ONE, 2.4, false, 0u, 0.0), 2u);
    EXPECT_EQ(levelByDistance(w, FAR_ONE, 2.4, true, 1u, 0.2), 1u);
    EXPECT_EQ(levelByDistance(w, FAR_ONE, 2.4, true, 2u, 0.2), 2u);
    EXPECT_EQ(levelByDistance(w, PINNED, 0.01, false, 0u, 0.0), 0u);
    EXPECT_EQ(levelByDistance(w, AROUND, 0.01, false, 0u, 0.0), 0u);

    // What is chosen anew with what was chosen before stays, whatever the limit and the hysteresis.
    vec2 u = random2(pathSeed(uvec2(gl_GlobalInvocationID.x, 0), 0u, 3u), 0u, 0u);
    float limit = exp2(8.0 * u.x - 4.0);
    for (uint last = 0u; last < 4u; ++last) {
        uint chosen = levelByError(w, FAR_ONE, limit, true, last, 0.9 * u.y);
        EXPECT_EQ(levelByError(w, FAR_ONE, limit, true, chosen, 0.9 * u.y), chosen);
        EXPECT_TRUE(screenError(w, FAR_ONE, far, chosen) <= limit);
        EXPECT_TRUE(chosen <= levelByError(w, FAR_ONE, limit, false, 0u, 0.0));
    }
}
