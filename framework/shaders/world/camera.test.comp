// SPDX-License-Identifier: MIT
// If these fail, images are flipped, stretched or blurred wrongly, and reprojected samples land in the wrong pixels.
// groups: 16
#version 460
#include "base/random.glsl"
#include "world/camera.glsl"
#include "world/test_world.glsl"
layout(local_size_x = 64) in;

void main() {
    uint id = gl_GlobalInvocationID.x;
    World w = testWorld();
    // A camera at (1, 2, 3) that looks along +X with a field of view of 90 degrees, 2:1.
    w.camera = CameraRecord(vec3(1, 2, 3), 0.25, vec3(0, 0, 2), 5.0, vec3(0, 1, 0), 0.01, vec3(1, 0, 0), 0u);
    vec2 film = random2(uvec2(id, 0), 0u, RANDOM_FILM), lens = random2(uvec2(id, 0), 0u, RANDOM_LENS);
    float t = 0.5 + 20.0 * random1(uvec2(id, 0), 0u, RANDOM_FREE);

    Ray ray = cameraRay(w, film, lens);
    EXPECT_NEAR(length(ray.direction), 1.0, 1e-6);
    EXPECT_NEAR(dot(ray.origin - w.camera.position, w.camera.forward), 0.0, 1e-6);
    EXPECT_TRUE(distance(ray.origin, w.camera.position) <= 0.2500001);
    // All rays of a film point meet in the plane of focus.
    vec3 meeting = w.camera.position + 5.0 * vec3(1.0, 1.0 - 2.0 * film.y, 2.0 * (2.0 * film.x - 1.0));
    EXPECT_NEAR(ray.origin + ray.direction * (5.0 / ray.direction.x), meeting, 2e-5);
    // There and back.
    EXPECT_NEAR(cameraProject(w, ray.origin + t * ray.direction, lens), vec3(film, t * ray.direction.x), 2e-5 * max(1.0, t) / min(1.0, t));
    EXPECT_TRUE(cameraProject(w, ray.origin - t * ray.direction, lens).z < 0.0);
    if (id > 0u) return;

    w.camera.aperture = 0.0;
    EXPECT_EQ(cameraRay(w, vec2(0.5), vec2(0.9)).origin, vec3(1, 2, 3));
    EXPECT_NEAR(cameraRay(w, vec2(0.5), vec2(0.9)).direction, vec3(1, 0, 0), 1e-6);
    EXPECT_NEAR(cameraRay(w, vec2(0.0, 0.0), vec2(0.5)).direction, normalize(vec3(1, 1, -2)), 1e-6);  // top left
    EXPECT_NEAR(cameraRay(w, vec2(1.0, 0.75), vec2(0.5)).direction, normalize(vec3(1, -0.5, 2)), 1e-6);
    EXPECT_NEAR(cameraProject(w, vec3(3, 3, 3), vec2(0.5)), vec3(0.5, 0.25, 2.0), 1e-6);
    // Orthographic: rays side by side, and a point's place on the film doesn't depend on its depth.
    World o = w;
    o.camera.orthographic = 1u;
    EXPECT_EQ(cameraRay(o, vec2(0.5), vec2(0.9)).origin, vec3(1, 2, 3));
    EXPECT_EQ(cameraRay(o, vec2(0.0, 0.75), vec2(0.9)).origin, vec3(1, 1.5, 1));
    EXPECT_EQ(cameraRay(o, vec2(0.0, 0.75), vec2(0.9)).direction, vec3(1, 0, 0));
    for (uint i = 0u; i < 64u; ++i) {
        vec2 at = random2(uvec2(i, 2), 0u, 0u);
        float depth = 0.01 + 100.0 * random1(uvec2(i, 2), 0u, 1u);
        Ray side = cameraRay(o, at, vec2(0.1));
        EXPECT_NEAR(cameraProject(o, side.origin + depth * side.direction, vec2(0.7)), vec3(at, depth), 1e-6 * max(1.0, depth));
        EXPECT_TRUE(cameraProject(o, side.origin - depth * side.direction, vec2(0.7)).z < 0.0);
        EXPECT_EQ(cameraProjectSky(o, side.direction, at, vec2(0.7)).xy, at);
        EXPECT_NEAR(cameraProjectSky(w, cameraRay(w, at, vec2(0.1)).direction, vec2(0), vec2(0.1)).xy, at, 1e-6);
    }
    // Uniform over the lens: the mean square distance from its centre is half the square of its radius.
    w.camera.aperture = 0.25;
    float sum = 0.0;
    for (uint i = 0u; i < 4096u; ++i) {
        vec3 origin = cameraRay(w, vec2(0.3), random2(uvec2(i, 1), 0u, 0u)).origin;
        sum += square(distance(origin, w.camera.position));
    }
    EXPECT_NEAR(sum / 4096.0, 0.03125, 0.0012);
    EXPECT_EQ(cameraRay(w, vec2(0.3), LENS_CENTRE).origin, w.camera.position);
}
