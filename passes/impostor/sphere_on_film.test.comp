// SPDX-License-Identifier: MIT
// If these fail, pixels that show an instance are not asked for it, or many are that cannot.
// groups: 4
#version 460
#include "base/random.glsl"
#include "impostor/sphere_on_film.glsl"
#include "world/test_world.glsl"
layout(local_size_x = 64) in;

const uint POINTS = 2048u;

vec3 onSphere(uint i) {
    float z = 1.0 - (2.0 * float(i) + 1.0) / float(POINTS), turn = 2.39996323 * float(i);
    return vec3(sqrt(1.0 - z * z) * vec2(cos(turn), sin(turn)), z);
}

/// Film points that show the sphere's points through some places on the lens: least in xy, greatest in zw.
vec4 filmOfSphere(World w, vec3 center, float radius, uint id) {
    vec4 all = vec4(FAR, FAR, -FAR, -FAR);
    for (uint i = 0u; i < POINTS; ++i) {
        vec3 film = cameraProject(w, center + radius * onSphere(i), random2(uvec2(id, i), 0u, RANDOM_LENS));
        if (film.z > 0.0) all = vec4(min(all.xy, film.xy), max(all.zw, film.xy));
    }
    return all;
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    World w = testWorld();
    // A camera at (1, 2, 3) that looks along +X with a field of view of 90 degrees, 2:1.
    w.camera = CameraRecord(vec3(1, 2, 3), 0.25, vec3(0, 0, 2), 5.0, vec3(0, 1, 0), 0.01, vec3(1, 0, 0), 0u);
    vec3 u = vec3(random2(uvec2(id, 1), 0u, RANDOM_FREE), random1(uvec2(id, 2), 0u, RANDOM_FREE));
    float radius = exp2(3.0 * u.z - 2.0), depth = radius * (1.05 + 20.0 * u.x * u.x);
    vec3 center = w.camera.position + depth * vec3(1.0, 3.0 * u.y - 1.5, 4.0 * u.z - 2.0);
    vec4 bounds;
    for (uint i = 0u; i < 3u; ++i) {
        w.camera.aperture = i == 1u ? 0.25 : 0.0;
        w.camera.orthographic = i == 2u ? 1u : 0u;
        EXPECT_TRUE(sphereOnFilm(w, center, radius, bounds));
        vec4 film = filmOfSphere(w, center, radius, id);
        vec4 slack = 1e-5 * (1.0 + abs(film));
        EXPECT_TRUE(all(greaterThanEqual(film.xy, bounds.xy - slack.xy)) && all(lessThanEqual(film.zw, bounds.zw + slack.zw)));
        // As tight as the points are dense, where the eye isn't too close for them.
        vec2 size = bounds.zw - bounds.xy;
        if (w.camera.aperture == 0.0 && depth > 1.5 * radius) EXPECT_NEAR((film.zw - film.xy) / size, vec2(1), 0.01);
        // Behind the camera nothing is to be seen, around it everything may be.
        EXPECT_TRUE(!sphereOnFilm(w, w.camera.position - vec3(1.01 * radius, 0, 0), radius, bounds));
        if (w.camera.orthographic != 0u) continue;
        EXPECT_TRUE(sphereOnFilm(w, w.camera.position + vec3(0.5 * radius, 0, 0), radius, bounds));
        EXPECT_TRUE(all(lessThan(bounds.xy, vec2(-1e6))) && all(greaterThan(bounds.zw, vec2(1e6))));
    }
}
