// SPDX-License-Identifier: MIT
// If these fail, views don't surround the object as evenly as they must, or a texel's point is not where it was seen.
// groups: 256
// passes: 2
#version 460
#include "base/test.glsl"
#include "base/math.glsl"
#include "impostor/views.glsl"
layout(local_size_x = 64) in;

const uint COUNT = 256u * 64u;

// Worst angle from any direction to its nearest view, degrees: at the corners of a cube; over the faces of an icosahedron; at the corners again.
const float WORST[3] = float[](54.7356, 37.3774, 35.2644);
const float APART[3] = float[](90.0, 63.4349, 45.0);
const uint SETS[3] = uint[](6u, 12u, 18u);

float angleToNearest(uint views, vec3 direction) {
    float nearest = -1.0;
    for (uint i = 0u; i < views; ++i) nearest = max(nearest, dot(direction, viewDirection(views, i)));
    return degrees(acos(min(nearest, 1.0)));
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (testPush.pass == 1u) {
        // What the spiral found comes as near to the worst as its points are dense, 2 degrees.
        if (id >= 3u) return;
        EXPECT_NEAR(float(testScratch[id]) / 1000.0, WORST[id], 2.0);
        return;
    }
    float z = 1.0 - (2.0 * float(id) + 1.0) / float(COUNT), turn = 2.39996323 * float(id);
    vec3 direction = vec3(sqrt(1.0 - z * z) * vec2(cos(turn), sin(turn)), z);
    for (uint s = 0u; s < 3u; ++s) {
        float angle = angleToNearest(SETS[s], direction);
        EXPECT_TRUE(angle <= WORST[s] + 0.01);
        atomicMax(testScratch[s], uint(1000.0 * angle));
    }
    // A face of the icosahedron, and the corners of the cube.
    EXPECT_NEAR(angleToNearest(12u, normalize(viewDirection(12u, 0u) + viewDirection(12u, 4u) + viewDirection(12u, 8u))), WORST[1], 0.01);
    EXPECT_NEAR(angleToNearest(6u, normalize(vec3(1, 1, -1))), WORST[0], 0.01);
    EXPECT_NEAR(angleToNearest(18u, normalize(vec3(-1, 1, 1))), WORST[2], 0.01);

    uint s = id % 3u, views = SETS[s], view = id / 3u % views;
    ImpostorView v = impostorView(views, view);
    EXPECT_EQ(v.d, viewDirection(views, view));
    EXPECT_NEAR(vec3(length(v.x), length(v.y), length(v.d)), vec3(1), 1e-6);
    EXPECT_NEAR(vec3(dot(v.x, v.y), dot(v.y, v.d), dot(v.d, v.x)), vec3(0), 1e-6);
    EXPECT_NEAR(cross(v.x, v.y), v.d, 1e-6);
    EXPECT_NEAR(outOfView(v, intoView(v, direction)), direction, 1e-6);
    float closest = 180.0;
    for (uint i = 0u; i < views; ++i)
        if (i != view) closest = min(closest, degrees(acos(dot(v.d, viewDirection(views, i)))));
    EXPECT_NEAR(closest, APART[s], 0.01);
    // The 18 begin with the 6.
    if (view < 6u) EXPECT_EQ(viewDirection(18u, view), viewDirection(6u, view));

    // Point and window, there and back.
    Impostors made;
    made.views = views;
    made.resolution = 64u << (id % 5u);
    made.levels = 5u + id % 5u;
    vec3 center = vec3(3, -2, 0.5);
    float radius = 0.7;
    vec3 window = vec3(fract(0.618 * float(id)), fract(0.755 * float(id)), fract(0.569 * float(id)));
    vec3 point = windowPoint(made, center, radius, v, window.xy, window.z);
    EXPECT_NEAR(windowOf(made, center, radius, v, point), window, 1e-5);
    EXPECT_NEAR(windowOf(made, center, radius, v, center + radius * v.d), vec3(0.5, 0.5, 0), 1e-5);
    EXPECT_NEAR(windowOf(made, center, radius, v, center - radius * v.d), vec3(0.5, 0.5, 1), 1e-5);
    // The sphere leaves a border of one texel.
    float border = 1.0 / float(made.resolution);
    vec3 rim = windowOf(made, center, radius, v, center + radius * v.x);
    EXPECT_NEAR(rim.x, 1.0 - border, 1e-6);
    EXPECT_NEAR(distance(windowPoint(made, center, radius, v, vec2(0, 0), 0.5), windowPoint(made, center, radius, v, vec2(border, 0), 0.5)),
                texelSide(made, radius, 0u), 1e-6);

    // Places in memory follow each other without a gap.
    uint expected = 0u;
    for (uint level = 0u; level < made.levels; ++level) {
        uint n = made.resolution >> level;
        EXPECT_EQ(texelIndex(made, level, 0u, uvec2(0u)), expected);
        EXPECT_EQ(texelIndex(made, level, views - 1u, uvec2(n - 1u)), expected + views * n * n - 1u);
        expected += views * n * n;
        if (level + 1u == made.levels) EXPECT_EQ(n, 4u);
    }
}
