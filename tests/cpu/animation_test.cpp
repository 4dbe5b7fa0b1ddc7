// SPDX-License-Identifier: MIT
// Poses over time: glTF's interpolations, the repeating clock, camera paths.
#include "gltf_model.h"

#include <framework/core/error.h>
#include <framework/scene/animation.h>
#include <framework/scene/camera.h>
#include <framework/scene/gltf/gltf.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace lodestir {
namespace {

void expectNear(const glm::vec4& value, const glm::vec4& expected, float tolerance = 1e-5f) {
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(value[i], expected[i], tolerance) << "component " << i;
}

// If this fails, animated things jump or drift.
TEST(Animation, StepHoldsAndLinearMixes) {
    AnimationChannel channel{.times = {1, 2, 4}, .values = {{0, 0, 0, 0}, {10, 0, 0, 0}, {20, 4, 0, 0}}};
    expectNear(evaluate(channel, 0), {0, 0, 0, 0});  // constant before the first and after the last key
    expectNear(evaluate(channel, 1.25f), {2.5f, 0, 0, 0});
    expectNear(evaluate(channel, 3), {15, 2, 0, 0});
    expectNear(evaluate(channel, 9), {20, 4, 0, 0});
    channel.interpolation = Interpolation::step;
    expectNear(evaluate(channel, 1.99f), {0, 0, 0, 0});
    expectNear(evaluate(channel, 2), {10, 0, 0, 0});
}

// If this fails, rotations take the long way round or change speed: a quarter turn about Z is an eighth at half time.
TEST(Animation, LinearRotationIsSphericalAndShort) {
    const float h = std::sqrt(0.5f);
    AnimationChannel channel{
        .value = AnimatedValue::rotation, .times = {0, 1}, .values = {{0, 0, 0, 1}, {0, 0, -h, -h}}};  // -q is the same rotation
    const float a = 3.14159265f / 8;
    expectNear(evaluate(channel, 0.5f), {0, 0, std::sin(a), std::cos(a)});
    expectNear(evaluate(channel, 0.25f), {0, 0, std::sin(a / 2), std::cos(a / 2)});
}

// If this fails, splines overshoot: values 0 and 2 with tangents 3 and -1 per second over 2 s. By hand at t = 1/2:
// p = 1/2 * 0 + 2 * 1/8 * 3 + 1/2 * 2 - 2 * 1/8 * (-1) = 0.75 + 1 + 0.25 = 2.
TEST(Animation, CubicFollowsHermite) {
    const AnimationChannel channel{.interpolation = Interpolation::cubic,
                                   .times = {0, 2},
                                   .values = {{0, 0, 0, 0}, {0, 0, 0, 0}, {3, 0, 0, 0}, {-1, 0, 0, 0}, {2, 0, 0, 0}, {0, 0, 0, 0}}};
    EXPECT_NEAR(evaluate(channel, 1).x, 2, 1e-5);
    EXPECT_NEAR(evaluate(channel, 0).x, 0, 1e-6);
    EXPECT_NEAR(evaluate(channel, 2).x, 2, 1e-6);
    EXPECT_NEAR((evaluate(channel, 0.001f).x - evaluate(channel, 0).x) / 0.001f, 3, 0.02);  // it leaves with its tangent
}

// If this fails, a fox that can sit, walk and run does all at once.
TEST(Animation, OneOfSeveralIsChosen) {
    GltfModel model;
    const int node = model.addTriangle();
    const int times = model.accessor(std::vector<float>{0, 1}, 5126, "SCALAR", 1);
    for (const float far : {1.0f, 5.0f}) {
        const int shift = model.positions({0, 0, 0, far, 0, 0});
        model.json["animations"].push_back({{"name", far > 1 ? "run" : "walk"},
                                            {"samplers", {{{"input", times}, {"output", shift}}}},
                                            {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}}}});
    }
    const Path file = model.write(Path(testing::TempDir()) / "lodestir_animation" / "fox.gltf");
    const auto reached = [&](const std::string& name) {
        Scene scene;
        loadGltf(file, scene, none, {.variant = {}, .animation = {name, {}}});
        return scene.nodeMatrices(29.999f)[0][3].x;
    };
    EXPECT_NEAR(reached("walk"), 1, 1e-3);
    EXPECT_NEAR(reached("run"), 5, 1e-3);
    EXPECT_NEAR(reached(""), 1, 1e-3) << "of two that move the same node the first counts";
    try {
        reached("rum");
        FAIL() << "it was loaded";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("fox.gltf has no animation \"rum\""), std::string::npos) << text;
        EXPECT_NE(text.find("did you mean \"run\""), std::string::npos) << text;
    }
}

// If this fails, frames show another time than the file's seconds.
TEST(Animation, ClockRepeatsAndHasSpeed) {
    Scene scene;
    scene.nodes = {{.name = "a"}, {.name = "b", .parent = 0, .translation = {0, 1, 0}}};
    scene.animation = {{.node = 0, .times = {0, 2}, .values = {{0, 0, 0, 0}, {4, 0, 0, 0}}}};
    scene.animationLength = 2;
    scene.framesPerSecond = 10;
    EXPECT_NEAR(scene.nodeMatrices(5)[1][3].x, 1, 1e-5);   // 0.5 s
    EXPECT_NEAR(scene.nodeMatrices(5)[1][3].y, 1, 1e-5);   // the child keeps its own place
    EXPECT_NEAR(scene.nodeMatrices(25)[1][3].x, 1, 1e-4);  // once around
    scene.animationSpeed = 2;
    EXPECT_NEAR(scene.nodeMatrices(5)[1][3].x, 2, 1e-5);
}

// If this fails, animations of a file move the wrong node or the wrong value.
TEST(Animation, LoadsFromGltf) {
    GltfModel model;
    model.addTriangle();
    const int times = model.accessor(std::vector<float>{0, 1}, 5126, "SCALAR", 1);
    const int turns = model.accessor(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 32767, 0, 0}, 5122, "VEC4", 4, true);
    model.json["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}},
                                 {"samplers", {{{"input", times}, {"output", turns}}}}}};
    Scene scene;
    loadGltf(model.write(Path(testing::TempDir()) / "lodestir_animation" / "model.gltf"), scene, none);
    ASSERT_EQ(scene.animation.size(), 1u);
    EXPECT_FLOAT_EQ(scene.animationLength, 1);
    const glm::mat4 quarter = scene.nodeMatrices(15)[0];  // 0.5 s of half a turn about +Y
    EXPECT_NEAR(quarter[0].z, -1, 1e-4);
    EXPECT_NEAR(quarter[2].x, 1, 1e-4);
}

/// A triangle that `count` animations move along x by these keys.
Scene moved(const std::vector<float>& times, const std::vector<float>& x, const char* interpolation = "LINEAR",
            const std::function<void(nlohmann::json&)>& change = {}) {
    GltfModel model;
    model.addTriangle();
    std::vector<float> xyz;
    for (float value : x) xyz.insert(xyz.end(), {value, 0, 0});
    const int input = model.accessor(times, 5126, "SCALAR", 1), output = model.positions(xyz);
    model.json["animations"] = {{{"name", "slide"},
                                 {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
                                 {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}}}};
    if (change) change(model.json);
    Scene scene;
    loadGltf(model.write(Path(testing::TempDir()) / "lodestir_animation" / "moved.gltf"), scene, none);
    scene.framesPerSecond = 30;
    return scene;
}

// If this fails, a wrong sampler reads past its keys, or the model is not shown because of it.
TEST(Animation, WhatCannotBePlayedIsLeftOut) {
    const auto noteOf = [](const Scene& scene) {
        EXPECT_TRUE(scene.animation.empty());
        EXPECT_EQ(scene.animationLength, 0);
        EXPECT_EQ(scene.instances.size(), 1u);
        return scene.notes.empty() ? std::string() : scene.notes.front();
    };
    EXPECT_NE(noteOf(moved({0, 1}, {0}))
                  .find("animation \"slide\" is left out: /animations/0/samplers/0/output: 1 values for 2 keys, expected 2"),
              std::string::npos);
    EXPECT_NE(noteOf(moved({0, 1}, {0, 0}, "CUBICSPLINE")).find("expected 6"), std::string::npos);
    EXPECT_NE(noteOf(moved({1, 0}, {0, 0})).find("times must not fall, key 1 does"), std::string::npos);
    EXPECT_NE(noteOf(moved({0, std::nanf("")}, {0, 0})).find("the time of key 1 is not finite"), std::string::npos);
    EXPECT_NE(noteOf(moved({0, 1}, {0, std::numeric_limits<float>::infinity()})).find("value 1 is not finite"), std::string::npos);
    EXPECT_NE(noteOf(moved({0, 1}, {0, 0}, "BEZIER")).find("there is no interpolation \"BEZIER\""), std::string::npos);
    EXPECT_NE(noteOf(moved({0, 1}, {0, 0}, "LINEAR", [](auto& json) { json["animations"][0]["samplers"][0]["input"] = 77; }))
                  .find("there is no accessor 77"),
              std::string::npos);
    const auto other = [](const char* key, int value) {
        return [=](auto& json) {
            (key == std::string("node") ? json["animations"][0]["channels"][0]["target"] : json["animations"][0]["channels"][0])[key] =
                value;
        };
    };
    EXPECT_NE(noteOf(moved({0, 1}, {0, 0}, "LINEAR", other("node", 5))).find("names a node or a sampler that is not there"),
              std::string::npos);
    EXPECT_NE(noteOf(moved({0, 1}, {0, 0}, "LINEAR", other("sampler", 5))).find("names a node or a sampler that is not there"),
              std::string::npos);
}

// If this fails, one clip that cannot be played takes another with it, or moves half of the model.
TEST(Animation, LeavesOutTheWholeClipAndNoOther) {
    const Scene scene = moved({0, 1}, {0, 2}, "LINEAR", [](auto& json) {
        nlohmann::json broken = json["animations"][0];
        broken["channels"].push_back({{"sampler", 1}, {"target", {{"node", 0}, {"path", "scale"}}}});
        broken["samplers"].push_back({{"input", 99}, {"output", 99}});
        json["animations"] = {broken, json["animations"][0]};
    });
    ASSERT_EQ(scene.animation.size(), 1u);
    EXPECT_FLOAT_EQ(scene.nodeMatrices(15)[0][3].x, 1);
    EXPECT_EQ(scene.notes.size(), 2u) << "which there are to choose from, and which is left out";
}

// Known answers: positions by hand. If this fails, jumps are smeared, or what begins before zero is shifted.
TEST(Animation, EqualTimesAreAJumpAndNegativeOnesBeforeTheStart) {
    const Scene jump = moved({0, 0.5f, 0.5f, 1}, {-1, -1, 1, 1});
    for (const auto& [frame, x] : {std::pair(0, -1), {14, -1}, {15, 1}, {29, 1}})
        EXPECT_FLOAT_EQ(jump.nodeMatrices(float(frame))[0][3].x, float(x)) << frame;
    const Scene thrice = moved({0, 0, 0.5f, 0.5f, 0.5f, 1}, {9, 0, 1, 7, 3, 4});
    for (const auto& [frame, x] : {std::pair(0.0f, 0.0f), {7.5f, 0.5f}, {15.0f, 3.0f}, {22.5f, 3.5f}})
        EXPECT_FLOAT_EQ(thrice.nodeMatrices(frame)[0][3].x, x) << frame;
    const Scene early = moved({-1, 0.5f, 1}, {-3, 0, 1});
    for (const auto& [frame, x] : {std::pair(0, -1.0f), {15, 0.0f}, {30 + 15, 0.0f}})
        EXPECT_NEAR(early.nodeMatrices(float(frame))[0][3].x, x, 1e-6) << frame;
    const Scene before = moved({-2, -1}, {5, 6});
    for (const float frame : {0.0f, 100.0f}) EXPECT_FLOAT_EQ(before.nodeMatrices(frame)[0][3].x, 6) << "its last key holds";
    const Scene cubic = moved({0, 0.5f, 0.5f, 1}, {0, 0, 0, 0, 1, 0, 0, 5, 0, 0, 6, 0}, "CUBICSPLINE");
    EXPECT_FLOAT_EQ(cubic.nodeMatrices(7.5f)[0][3].x, 0.5f);
    EXPECT_FLOAT_EQ(cubic.nodeMatrices(15)[0][3].x, 5);
    EXPECT_FLOAT_EQ(cubic.nodeMatrices(22.5f)[0][3].x, 5.5f);
}

// If this fails, camera keys are missed: linear between, constant outside.
TEST(Camera, KeysMixLinearly) {
    Scene scene;
    scene.camera.keys = {{.frame = 10, .position = {0, 0, 0}, .target = {0, 0, -1}, .fovy = 0.5f, .focus = 1},
                         {.frame = 20, .position = {4, 0, 0}, .target = {4, 0, -3}, .fovy = 0.7f, .focus = 3}};
    EXPECT_NEAR(scene.cameraAt(0).position.x, 0, 1e-6);
    EXPECT_NEAR(scene.cameraAt(12.5f).position.x, 1, 1e-5);
    EXPECT_NEAR(scene.cameraAt(15).fovy, 0.6, 1e-6);
    EXPECT_NEAR(scene.cameraAt(15).focus, 2, 1e-6);
    EXPECT_NEAR(scene.cameraAt(99).position.x, 4, 1e-6);
}

// If this fails, a camera that rides on a node looks along another axis than its -Z.
TEST(Camera, RidesOnItsNode) {
    Scene scene;
    const float h = std::sqrt(0.5f);
    scene.nodes = {
        {.name = "cart", .translation = {1, 2, 3}, .rotation = glm::quat(h, 0, h, 0), .scale = {2, 2, 2}}};  // a quarter turn to the left
    scene.camera = {.keys = {{.focus = 5}}, .node = 0};
    const CameraKey pose = scene.cameraAt(3);
    EXPECT_NEAR(pose.position.z, 3, 1e-6);
    EXPECT_NEAR(pose.target.x, 1 - 5, 1e-5);
    EXPECT_NEAR(pose.target.z, 3, 1e-5);
    EXPECT_NEAR(pose.up.y, 1, 1e-6);
}

// If this fails, models are cut off or are specks when no camera is given: every corner is in the frame, one nearly touches its edge.
TEST(Camera, FramesBounds) {
    for (const std::array<glm::vec3, 2> bounds : {std::array<glm::vec3, 2>{glm::vec3(-1), glm::vec3(1)},
                                                  {glm::vec3(10, 0, 0), glm::vec3(10.02f, 5, 0.1f)},
                                                  {glm::vec3(-50, -1, -50), glm::vec3(50, 1, 50)}}) {
        const CameraKey camera = frameBounds(bounds);
        const glm::vec3 forward = glm::normalize(camera.target - camera.position), right = glm::normalize(glm::cross(forward, camera.up)),
                        up = glm::cross(right, forward);
        float fullest = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 p =
                glm::vec3(bounds[std::size_t(corner & 1)].x, bounds[std::size_t(corner >> 1 & 1)].y, bounds[std::size_t(corner >> 2)].z) -
                camera.position;
            const float depth = glm::dot(p, forward), half = std::tan(camera.fovy / 2) * depth;
            ASSERT_GT(depth, 0);
            fullest = std::max({fullest, std::abs(glm::dot(p, up)) / half, std::abs(glm::dot(p, right)) / (half * 16 / 9)});
        }
        EXPECT_LT(fullest, 1);
        EXPECT_GT(fullest, 0.8);
    }
}

}  // namespace
}  // namespace lodestir
