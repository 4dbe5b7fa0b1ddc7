// SPDX-License-Identifier: MIT
// The camera of the viewer, with answers that geometry gives.
#include <framework/app/view/orbit_camera.h>

#include <gtest/gtest.h>

#include <cmath>

namespace lodestir {
namespace {

constexpr float pi = 3.14159265f;

CameraKey fromFront() { return {.position = {0, 0, 5}, .target = {0, 0, 0}, .fovy = 0.8f, .focus = 5}; }

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-4f) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

/// Where a point lies in the picture, 0..1 to the right and downwards: the pinhole, written out.
glm::vec2 project(const CameraKey& camera, const glm::vec3& point, float aspect) {
    const glm::vec3 forward = glm::normalize(camera.target - camera.position), right = glm::normalize(glm::cross(forward, camera.up)),
                    up = glm::cross(right, forward);
    const glm::vec3 v = point - camera.position;
    const float height = camera.height > 0 ? camera.height / 2 : std::tan(camera.fovy / 2) * glm::dot(v, forward);
    return {0.5f + 0.5f * glm::dot(v, right) / (height * aspect), 0.5f - 0.5f * glm::dot(v, up) / height};
}

TEST(OrbitCamera, AQuarterTurnToTheRight) { expectNear(orbited(fromFront(), pi / 2, 0).position, {5, 0, 0}); }

TEST(OrbitCamera, UpwardsKeepsDistanceAndTarget) {
    const CameraKey moved = orbited(fromFront(), 0, pi / 4);
    expectNear(moved.position, {0, 5 * std::sqrt(0.5f), 5 * std::sqrt(0.5f)});
    expectNear(moved.target, {0, 0, 0});
}

TEST(OrbitCamera, StopsShortOfThePole) {
    const CameraKey above = orbited(fromFront(), 0, 10), below = orbited(fromFront(), 0, -10);
    EXPECT_GT(above.position.y, 4.99f);
    EXPECT_GT(above.position.z, 0.05f);  // still on this side: `up` stays up
    EXPECT_LT(below.position.y, -4.99f);
    EXPECT_GT(below.position.z, 0.05f);
}

TEST(OrbitCamera, FullTurnComesBack) {
    CameraKey camera = orbited(fromFront(), 0.3f, 0.4f);
    const glm::vec3 start = camera.position;
    for (int i = 0; i < 36; ++i) camera = orbited(camera, 2 * pi / 36, 0);
    expectNear(camera.position, start, 1e-3f);
}

TEST(OrbitCamera, LooksAroundFromWhereItStands) {
    // Five before the origin, looking along -z: a quarter turn to the right looks along +x.
    const CameraKey right = turned(fromFront(), pi / 2, 0);
    expectNear(right.position, fromFront().position);
    expectNear(right.target, fromFront().position + glm::vec3(5, 0, 0));
    const CameraKey up = turned(fromFront(), 0, pi / 4);
    expectNear(up.target, fromFront().position + 5 / std::sqrt(2.0f) * glm::vec3(0, 1, -1));
    const CameraKey steep = turned(fromFront(), 0, 10);
    EXPECT_LT(steep.target.z, 5) << "over the pole";
    EXPECT_GT(steep.target.y, 4.99f);
}

TEST(OrbitCamera, FliesBesideWhatItLooksAt) {
    const CameraKey turnedRight = turned(fromFront(), pi / 2, 0), moved = flown(turnedRight, {0.2f, 0.4f, 1});
    expectNear(moved.position, turnedRight.position + glm::vec3(5, 2, 1));  // its right is +z
    expectNear(moved.target - moved.position, turnedRight.target - turnedRight.position);
    EXPECT_EQ(moved.focus, turnedRight.focus);
}

TEST(OrbitCamera, WhatWasUnderThePointerFollowsIt) {
    // A tenth of the picture's height to the right moves the target there, at any aspect.
    const CameraKey camera = orbited(fromFront(), 0.7f, 0.2f), moved = panned(camera, -0.1f, 0.05f);
    const glm::vec2 at = project(moved, camera.target, 1.5f);
    EXPECT_NEAR(at.x, 0.5f + 0.1f / 1.5f, 1e-5f);
    EXPECT_NEAR(at.y, 0.5f + 0.05f, 1e-5f);
}

TEST(OrbitCamera, DollyKeepsWhatIsSharpSharp) {
    CameraKey camera = fromFront();
    camera.focus = 4;  // a plane one unit before the target
    const CameraKey moved = dollied(camera, 0.5f);
    expectNear(moved.position, {0, 0, 2.5f});
    EXPECT_NEAR(moved.focus, 1.5f, 1e-5f);
    EXPECT_GT(dollied(camera, 0).position.z, 0);  // never into the target
}

// Nothing becomes larger by coming nearer: the picture shrinks or grows.
TEST(OrbitCamera, OrthographicDollyAndPan) {
    CameraKey camera = fromFront();
    camera.height = 3;
    const CameraKey moved = dollied(camera, 0.5f);
    EXPECT_EQ(moved.position, camera.position);
    EXPECT_NEAR(moved.height, 1.5f, 1e-6f);
    expectNear(panned(camera, 0.5f, -1).target, {1.5f, -3, 0});
    EXPECT_EQ(cameraJson(camera).dump(-1),
              Json::parse(R"({"position":[0.0,0.0,5.0],"target":[0.0,0.0,0.0],"up":[0.0,1.0,0.0],"orthographic":3.0,"focus":5.0})", "x")
                  .dump(-1));
}

TEST(OrbitCamera, DollyAtAnyScale) {
    for (const float scale : {1e-5f, 1e8f}) {
        const CameraKey camera{.position = {0, 0, scale}, .focus = scale};
        EXPECT_NEAR(dollied(camera, 0.9f).position.z, 0.9f * scale, 1e-6f * scale);
    }
}

TEST(OrbitCamera, FramesAllCorners) {
    const std::array<glm::vec3, 2> bounds{glm::vec3(-3, 2, -1), glm::vec3(4, 5, 7)};
    for (const float aspect : {0.5f, 1.0f, 1.78f, -1.78f}) {
        CameraKey start = fromFront();
        start.height = aspect < 0 ? 2 : 0;
        const CameraKey camera = framed(orbited(start, 1.1f, 0.5f), bounds, std::abs(aspect));
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec2 at =
                project(camera, {bounds[corner & 1].x, bounds[(corner >> 1) & 1].y, bounds[corner >> 2].z}, std::abs(aspect));
            EXPECT_TRUE(at.x > 0 && at.x < 1 && at.y > 0 && at.y < 1) << aspect << " " << corner;
        }
    }
    EXPECT_EQ(framed(fromFront(), {glm::vec3(1e30f), glm::vec3(-1e30f)}, 1).position, fromFront().position);  // nothing there
}

TEST(OrbitCamera, WarpIsExactInThePlaneOfTheTarget) {
    for (const glm::vec2 heights : {glm::vec2(0, 0), glm::vec2(3, 2), glm::vec2(0, 2), glm::vec2(3, 0)}) {
        CameraKey from = orbited(fromFront(), 0.4f, 0.3f);
        CameraKey to = dollied(panned(orbited(from, 0.25f, -0.2f), 0.1f, 0.2f), 0.7f);
        to.fovy = 0.6f;
        from.height = heights.x;
        to.height = heights.y;
        const float aspect = 1.6f;
        const glm::mat3 warp = warpBetween(from, to, aspect);
        const glm::vec3 forward = glm::normalize(from.target - from.position), right = glm::normalize(glm::cross(forward, from.up)),
                        up = glm::cross(right, forward);
        for (const glm::vec2 offset : {glm::vec2(0, 0), glm::vec2(1, 0.3f), glm::vec2(-0.4f, 0.9f)}) {
            const glm::vec3 point = from.target + offset.x * right + offset.y * up;
            const glm::vec2 seen = project(to, point, aspect), was = project(from, point, aspect);
            const glm::vec3 mapped = warp * glm::vec3(seen, 1);
            EXPECT_GT(mapped.z, 0);
            EXPECT_NEAR(mapped.x / mapped.z, was.x, 1e-4f);
            EXPECT_NEAR(mapped.y / mapped.z, was.y, 1e-4f);
        }
    }
}

TEST(OrbitCamera, WarpOfTheSameCameraIsTheIdentity) {
    const CameraKey camera = orbited(fromFront(), 0.4f, 0.3f);
    glm::mat3 warp = warpBetween(camera, camera, 1.6f);
    warp /= warp[2][2];
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) EXPECT_NEAR(warp[c][r], c == r ? 1.0f : 0.0f, 2e-5f);
}

TEST(OrbitCamera, JsonIsASceneFilesCamera) {
    CameraKey camera = fromFront();
    camera.fovy = pi / 4;
    camera.aperture = 0.0125f;
    EXPECT_EQ(cameraJson(camera).dump(-1),
              Json::parse(
                  R"({"position":[0.0,0.0,5.0],"target":[0.0,0.0,0.0],"up":[0.0,1.0,0.0],"fovy":45.0,"aperture":0.0125,"focus":5.0})", "x")
                  .dump(-1));
}

}  // namespace
}  // namespace lodestir
