// SPDX-License-Identifier: MIT
// If these fail, a view of an octahedral impostor is looked up where another one was baked, or brightness jumps from cell to cell.
// groups: 256
#version 460
#include "base/test.glsl"
#include "impostor/octahedral_grid.glsl"
layout(local_size_x = 64) in;

const uint COUNT = 256u * 64u;

float weightOf(GridViews g, uint view) {
    float sum = 0.0;
    for (uint i = 0u; i < 3u; ++i) sum += g.views[i] == view ? g.weights[i] : 0.0;
    return sum;
}

/// By the corners of each octant, which the map takes to straight edges.
void knownPlaces() {
    EXPECT_NEAR(gridPlace(false, vec3(0, 1, 0)), vec2(0), 1e-6);
    EXPECT_NEAR(gridPlace(false, vec3(1, 0, 0)), vec2(1, 0), 1e-6);
    EXPECT_NEAR(gridPlace(false, vec3(0, 0, -1)), vec2(0, -1), 1e-6);
    EXPECT_NEAR(gridPlace(false, normalize(vec3(1, 1, 1))), vec2(1.0 / 3.0), 1e-6);
    EXPECT_NEAR(gridPlace(false, normalize(vec3(1, -1, 1))), vec2(2.0 / 3.0), 1e-6);
    EXPECT_NEAR(abs(gridPlace(false, vec3(0, -1, 0))), vec2(1), 1e-6);
    EXPECT_NEAR(gridPlace(true, vec3(0, 1, 0)), vec2(0), 1e-6);
    EXPECT_NEAR(gridPlace(true, vec3(1, 0, 0)), vec2(1, 1), 2e-5);  // the horizon's height
    EXPECT_NEAR(gridPlace(true, vec3(0, 0, 1)), vec2(1, -1), 2e-5);
    EXPECT_NEAR(gridPlace(true, normalize(vec3(1, 0, 1))), vec2(1, 0), 2e-5);
    // All corners of the full map are the lower pole; those of the hemisphere's are the axes of the horizon.
    for (uint i = 0u; i < 4u; ++i) {
        vec2 corner = 2.0 * vec2(i & 1u, i >> 1) - 1.0;
        EXPECT_NEAR(gridDirection(false, corner), vec3(0, -1, 0), 1e-6);
        EXPECT_NEAR(gridDirection(true, corner), i == 0u ? vec3(-1, 0, 0) : i == 1u ? vec3(0, 0, 1) : i == 2u ? vec3(0, 0, -1) : vec3(1, 0, 0), 1e-6);
    }
    // From below the horizon, even from straight below, there is an answer.
    EXPECT_NEAR(length(gridDirection(true, gridPlace(true, vec3(0, -1, 0)))), 1.0, 1e-6);
    EXPECT_NEAR(gridDirection(true, gridPlace(true, normalize(vec3(3, -2, 0)))), vec3(1, 0, 0), 2e-5);
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    float z = 1.0 - (2.0 * float(id) + 1.0) / float(COUNT), turn = 2.39996323 * float(id);
    vec3 direction = vec3(sqrt(1.0 - z * z) * vec2(cos(turn), sin(turn)), z).xzy;
    if (id == 0u) knownPlaces();

    // There and back.
    EXPECT_NEAR(gridDirection(false, gridPlace(false, direction)), direction, 1e-5);
    vec3 upper = normalize(vec3(direction.x, abs(direction.y) + HORIZON, direction.z));
    EXPECT_NEAR(gridDirection(true, gridPlace(true, upper)), upper, 1e-5);
    vec2 place = 2.0 * fract(vec2(0.6180340, 0.7548777) * float(id)) - 1.0;
    if (maxComponent(vec3(abs(place), 0.0)) < 0.999) EXPECT_NEAR(gridPlace(false, gridDirection(false, place)), place, 1e-5);  // borders are there twice
    if (maxComponent(vec3(abs(place), 0.0)) < 0.99) EXPECT_NEAR(gridPlace(true, gridDirection(true, place)), place, 1e-5);

    // Weights make 1, count no view that isn't there, and mix places to the one that was asked for.
    for (uint across = 2u; across <= 32u; across *= 2u) {
        GridViews g = viewsAround(across, place);
        EXPECT_NEAR(g.weights.x + g.weights.y + g.weights.z, 1.0, 1e-6);
        EXPECT_TRUE(all(greaterThanEqual(g.weights, vec3(0))));
        EXPECT_TRUE(all(lessThan(g.views, uvec3(across * across))));
        vec2 mean = vec2(0);
        for (uint i = 0u; i < 3u; ++i) mean += g.weights[i] * placeOfView(across, g.views[i]);
        EXPECT_NEAR(mean, place, 1e-5);
        // Across the borders of triangles and cells nothing jumps: a step so small moves weights by no more than it.
        vec2 nudge = vec2(1e-4, -0.7e-4), beside = clamp(place + nudge, -1.0, 1.0);
        GridViews h = viewsAround(across, beside);
        for (uint i = 0u; i < 3u; ++i) EXPECT_NEAR(weightOf(h, g.views[i]), g.weights[i], 2e-4 * float(across));
        // From where a view stands it is seen alone, all corners and borders included.
        uint view = id % (across * across);
        GridViews own = viewsAround(across, placeOfView(across, view));
        EXPECT_NEAR(weightOf(own, view), 1.0, 1e-5);
        for (uint hemi = 0u; hemi < 2u; ++hemi) {
            vec3 d = gridDirection(hemi != 0u, placeOfView(across, view));
            GridViews met = viewsAround(across, gridPlace(hemi != 0u, d));
            vec3 seen = vec3(0);
            for (uint i = 0u; i < 3u; ++i) seen += met.weights[i] * gridDirection(hemi != 0u, placeOfView(across, met.views[i]));
            EXPECT_NEAR(seen, d, 1e-5 * float(across));
        }
    }
}
