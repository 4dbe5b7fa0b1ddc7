// SPDX-License-Identifier: MIT
// Scene files: what they describe arrives; every bad one in tests/errors/scenes gives the message written beside it.
#include "gltf_model.h"

#include <framework/core/error.h>
#include <framework/scene/scene.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lodestir {
namespace {

Path folder() { return Path(testing::TempDir()) / "lodestir_scene"; }

/// Writes triangle.gltf (a node "leaf") beside the scene file and loads the scene.
Scene load(const std::string& text) {
    GltfModel model;
    model.addTriangle();
    model.json["nodes"][0]["name"] = "leaf";
    model.write(folder() / "triangle.gltf");
    writeFile(folder() / "scene.json", text);
    return loadScene(folder() / "scene.json");
}

bool hasNote(const Scene& scene, const std::string& part) {
    return std::any_of(scene.notes.begin(), scene.notes.end(),
                       [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

// If this fails, instances stand elsewhere: scale first, then rotations about X, Y, Z, then the translation.
TEST(SceneFile, PlacesInstancesAndSharesMeshes) {
    const Scene scene = load(R"({"format": 1, "models": {"leaf model": {"file": "triangle.gltf"}}, "instances": [
        {"model": "leaf model", "name": "a", "translation": [1, 2, 3]},
        {"model": "leaf model", "name": "b", "rotationDegrees": [90, 0, 90], "scale": 2},
        {"model": "leaf model", "rotation": [0, 0, 1, 1], "scale": [1, 3, 1]}]})");
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.meshes.size(), 1u);
    const auto matrices = scene.nodeMatrices(0);
    const auto at = [&](std::size_t i, glm::vec3 p) { return glm::vec3(matrices[scene.instances[i].node] * glm::vec4(p, 1)); };
    EXPECT_NEAR(glm::distance(at(0, {0, 1, 0}), {1, 3, 3}), 0, 1e-5);
    EXPECT_NEAR(glm::distance(at(1, {0, 1, 0}), {0, 0, 2}), 0, 1e-5);  // +Y -> about X -> +Z, which turning about Z leaves
    EXPECT_NEAR(glm::distance(at(1, {1, 0, 0}), {0, 2, 0}), 0, 1e-5);
    EXPECT_NEAR(glm::distance(at(2, {0, 1, 0}), {-3, 0, 0}), 0, 1e-5);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) EXPECT_TRUE(scene.nodes[i].parent == none || scene.nodes[i].parent < i);
}

// If this fails, scenes that were written on Windows find neither models nor environment.
TEST(SceneFile, PathsMayHaveBackslashes) {
    GltfModel model;
    model.addTriangle();
    model.write(folder() / "parts" / "leaf.gltf");
    writeFile(folder() / "parts/sky.hdr",
              std::string_view("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x80\x80\x80\x80\x80\x80\x80"));
    writeFile(folder() / "scene.json", std::string_view(R"({"format": 1, "models": {"leaf": {"file": "parts\\leaf.gltf"}},
        "environment": {"type": "map", "file": ".\\parts\\sky.hdr"}})"));
    const Scene scene = loadScene(folder() / "scene.json");
    EXPECT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.environment.width, 2);
}

// If this fails, a shoe comes in one colour only, or a typing mistake in its name in a colour that nobody asked for.
TEST(SceneFile, ChoosesMaterialVariants) {
    GltfModel model;
    model.addTriangle();
    model.json["materials"] = {{{"name", "plain"}}, {{"name", "midnight"}}, {{"name", "street"}}};
    model.json["extensionsUsed"] = {"KHR_materials_variants"};
    model.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "Midnight"}}, {{"name", "Beach"}}, {{"name", "Street"}}};
    nlohmann::json& primitive = model.json["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {0}}}, {{"material", 2}, {"variants", {2}}}};
    model.write(folder() / "shoe.gltf");
    const auto materialWith = [](const std::string& variant) {
        writeFile(folder() / "shoe.json", R"({"format": 1, "models": {"shoe": {"file": "shoe.gltf")" + variant + "}}}");
        const Scene scene = loadScene(folder() / "shoe.json");
        EXPECT_EQ(hasNote(scene, "material variants to choose from: \"Midnight\", \"Beach\", \"Street\""), variant.empty());
        return scene.materials[scene.meshes.at(0).levels.at(0).materials.at(0)].name;
    };
    EXPECT_EQ(materialWith(""), "plain");
    EXPECT_EQ(materialWith(R"(, "variant": "Midnight")"), "midnight");
    EXPECT_EQ(materialWith(R"(, "variant": "Beach")"), "plain");
    EXPECT_EQ(materialWith(R"(, "variant": "Street")"), "street");
    try {
        materialWith(R"(, "variant": "Midnigt")");
        FAIL() << "it was loaded";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("shoe.json:1:"), std::string::npos) << text;
        EXPECT_NE(text.find("shoe.gltf has no material variant \"Midnigt\""), std::string::npos) << text;
        EXPECT_NE(text.find("did you mean \"Midnight\""), std::string::npos) << text;
    }
}

// If this fails, a sun from a direction of large numbers makes a sky of NaN, and a rotation by such numbers makes things vanish.
TEST(SceneFile, HugeNumbersStillHaveADirection) {
    const Scene scene = load(R"({"format": 1, "models": {"leaf": {"file": "triangle.gltf"}},
        "instances": [{"model": "leaf", "rotation": [0, 0, 2e38, 2e38]}],
        "environment": {"type": "sky", "sunDirection": [-0.8, 1e38, 1e38]}})");
    const glm::vec3 turned(scene.nodeMatrices(0)[scene.instances[0].node] * glm::vec4(0, 1, 0, 1));
    EXPECT_NEAR(glm::distance(turned, {-1, 0, 0}), 0, 1e-5);
    for (const glm::vec3& radiance : scene.environment.radiance) ASSERT_TRUE(radiance.x >= 0 && std::isfinite(radiance.x));
}

// If this fails, a file without "instances" shows nothing.
TEST(SceneFile, PlacesEveryModelOnceByItself) {
    const Scene scene = load(R"({"format": 1, "models": {"one": {"file": "triangle.gltf"}, "two": {"file": "triangle.gltf"}}})");
    EXPECT_EQ(scene.instances.size(), 2u);
    EXPECT_TRUE(hasNote(scene, "there is no camera"));
    EXPECT_TRUE(hasNote(scene, "a clear sky"));
    EXPECT_EQ(scene.environment.type, EnvironmentType::sky);
    ASSERT_EQ(scene.camera.keys.size(), 1u);
}

// If this fails, a dark room gets a sky nobody asked for.
TEST(SceneFile, KeepsTheDarkThatWasAskedFor) {
    const Scene scene = load(
        R"({"format": 1, "models": {"one": {"file": "triangle.gltf"}}, "environment": {"type": "constant", "color": [1, 2, 3], "strength": 0}})");
    EXPECT_EQ(scene.environment.type, EnvironmentType::constant);
    EXPECT_EQ(scene.environment.radiance[0], glm::vec3(0));
    EXPECT_EQ(scene.exposure, 0);
}

// If this fails, lights shine along another axis or cones are read in another unit.
TEST(SceneFile, TurnsLights) {
    const Scene scene = load(R"({"format": 1, "models": {"one": {"file": "triangle.gltf"}}, "lights": [
        {"type": "directional", "direction": [0, -2, 0], "intensity": 3, "color": [1, 0.5, 0]},
        {"type": "spot", "position": [1, 2, 3], "direction": [0, 0, 1], "innerConeDegrees": 10, "outerConeDegrees": 30}]})");
    ASSERT_EQ(scene.lights.size(), 2u);
    const auto matrices = scene.nodeMatrices(0);
    const auto shine = [&](std::size_t i) { return -glm::vec3(matrices[scene.lights[i].node][2]); };
    EXPECT_NEAR(glm::distance(shine(0), {0, -1, 0}), 0, 1e-5);
    EXPECT_NEAR(glm::distance(shine(1), {0, 0, 1}), 0, 1e-5);
    EXPECT_NEAR(matrices[scene.lights[1].node][3].y, 2, 1e-6);
    EXPECT_NEAR(scene.lights[1].outerCone, std::acos(-1.0) / 6, 1e-6);
    EXPECT_FLOAT_EQ(scene.lights[0].intensity, 3);
    EXPECT_FALSE(hasNote(scene, "sky"));
}

// If this fails, cameras are read wrongly: degrees, a focus that nobody gives, keys that inherit.
TEST(SceneFile, ReadsCameraAndKeyframes) {
    const Scene scene = load(R"({"format": 1, "models": {"one": {"file": "triangle.gltf"}},
        "camera": {"position": [0, 0, 5], "target": [0, 0, 1], "fovy": 90, "aperture": 0.1,
                   "keyframes": [{"frame": 0}, {"frame": 10, "position": [3, 0, 5], "fovy": 45, "focus": 7}]},
        "animation": {"framesPerSecond": 24, "speed": 0.5}, "cut": [40, 12], "exposure": -1.5})");
    ASSERT_EQ(scene.camera.keys.size(), 2u);
    EXPECT_NEAR(scene.cameraAt(0).fovy, std::acos(0.0), 1e-6);
    EXPECT_NEAR(scene.cameraAt(0).focus, 4, 1e-6);
    EXPECT_NEAR(scene.cameraAt(10).focus, 7, 1e-6);
    EXPECT_NEAR(scene.cameraAt(5).position.x, 1.5, 1e-6);
    EXPECT_NEAR(scene.cameraAt(10).aperture, 0.1, 1e-6);
    EXPECT_EQ(scene.cuts, (std::vector<int>{12, 40}));
    EXPECT_FLOAT_EQ(scene.framesPerSecond, 24);
    EXPECT_FLOAT_EQ(scene.animationSpeed, 0.5f);
    EXPECT_FLOAT_EQ(scene.exposure, -1.5f);
}

// What the camera says of its lens holds for keyframes, with a place of its own or without.
TEST(SceneFile, OrthographicCamerasAndInheritedLenses) {
    const Scene scene = load(R"({"format": 1, "models": {"one": {"file": "triangle.gltf"}},
        "camera": {"orthographic": 3, "keyframes": [{"frame": 0}, {"frame": 10, "orthographic": 5}]}})");
    EXPECT_EQ(scene.cameraAt(0).height, 3);
    EXPECT_NEAR(scene.cameraAt(5).height, 4, 1e-6);
    const Scene lens = load(R"({"format": 1, "models": {"one": {"file": "triangle.gltf"}},
        "camera": {"fovy": 30, "keyframes": [{"frame": 0}, {"frame": 10, "position": [0, 0, 9]}]}})");
    EXPECT_NEAR(glm::degrees(lens.cameraAt(10).fovy), 30, 1e-4);
    EXPECT_EQ(lens.cameraAt(10).height, 0);
}

// If this fails, switches of level hit another instance. Names are those of scene-file instances or of the model's nodes.
TEST(SceneFile, FindsInstancesOfTheSchedule) {
    const Scene scene = load(R"({"format": 1, "models": {"m": {"file": "triangle.gltf"}},
        "instances": [{"model": "m", "name": "left"}, {"model": "m", "name": "right"}],
        "lod": {"mode": "schedule", "pixelError": 0.5,
                "schedule": [{"frame": 40, "instance": "right", "level": 1}, {"frame": 50, "instance": "leaf", "level": 2}, {"frame": 60, "level": 0}]}})");
    EXPECT_EQ(scene.lod.mode, LodMode::schedule);
    EXPECT_FLOAT_EQ(scene.lod.pixelError, 0.5f);
    ASSERT_EQ(scene.lod.schedule.size(), 4u);
    EXPECT_EQ(scene.lod.schedule[0].instance, 1u);
    EXPECT_EQ(scene.lod.schedule[0].level, 1);
    EXPECT_EQ(scene.lod.schedule[1].instance, 0u);  // both instances have a node "leaf"
    EXPECT_EQ(scene.lod.schedule[2].instance, 1u);
    EXPECT_EQ(scene.lod.schedule[3].instance, none);
}

// If this fails, a model called like one of its own nodes switches all of them: a name means an instance before it means a group.
TEST(SceneFile, InstanceNamesGoBeforeModelNames) {
    GltfModel model;
    model.addTriangle();
    model.json["nodes"][0]["name"] = "rock";
    model.json["nodes"].push_back({{"name", "pebble"}, {"mesh", 0}});
    model.json["scenes"][0]["nodes"] = {0, 1};
    model.write(folder() / "rocks.gltf");
    writeFile(
        folder() / "rocks.json",
        std::string_view(
            R"({"format": 1, "models": {"rock": {"file": "rocks.gltf"}}, "lod": {"schedule": [{"frame": 4, "instance": "rock", "level": 1}]}})"));
    const Scene scene = loadScene(folder() / "rocks.json");
    ASSERT_EQ(scene.instances.size(), 2u);
    ASSERT_EQ(scene.lod.schedule.size(), 1u);
    EXPECT_EQ(scene.instances[scene.lod.schedule[0].instance].name, "rock");
}

// If this fails, a model cannot be looked at without writing a scene file for it.
TEST(SceneFile, LoadsAModelByItself) {
    GltfModel model;
    model.addTriangle();
    const Scene scene = loadScene(model.write(folder() / "alone.gltf"));
    EXPECT_EQ(scene.instances.size(), 1u);
    EXPECT_TRUE(hasNote(scene, "there is no camera"));
    EXPECT_GE(scene.materials.size(), 1u);
    EXPECT_THROW(loadScene(folder() / "no_such_file.json"), Error);
    EXPECT_THROW(loadScene(folder()), Error);
}

// If this fails, people get another message than the one that was agreed, or a bad file is believed. NAME.json holds
// mistakes; NAME.expected is the whole message, the folder left out. LODESTIR_WRITE_EXPECTED=1 writes them anew.
TEST(SceneFile, ReportsEveryProblemOfBadFiles) {
    const Path errors = Path(LODESTIR_SOURCE_DIR) / "tests" / "errors" / "scenes";
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(errors)) {
        if (entry.path().extension() != ".json") continue;
        ++count;
        std::string message;
        try {
            loadScene(entry.path());
        } catch (const Error& error) {
            message = error.what();
        }
        for (std::size_t at; (at = message.find(errors.string() + "/")) != std::string::npos;)
            message.erase(at, errors.string().size() + 1);
        const Path expected = Path(entry.path()).replace_extension(".expected");
        if (std::getenv("LODESTIR_WRITE_EXPECTED")) writeFile(expected, message + "\n");
        EXPECT_EQ(message + "\n", readText(expected)) << entry.path();
    }
    EXPECT_GE(count, 10u);
}

}  // namespace
}  // namespace lodestir
