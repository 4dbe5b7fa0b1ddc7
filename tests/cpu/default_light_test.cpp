// SPDX-License-Identifier: MIT
// Models without light are not black: which light is added, and when none is.
#include "gltf_model.h"

#include <framework/scene/scene.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace lodestir {
namespace {

/// A cube from -1 to 1 with all its sides or without its top, seen from its middle or from outside.
Scene cube(bool open, bool inside, const std::string& material = "{}") {
    GltfModel model;
    const int corners = model.positions({-1, -1, -1, 1, -1, -1, 1, -1, 1, -1, -1, 1, -1, 1, -1, 1, 1, -1, 1, 1, 1, -1, 1, 1});
    std::vector<std::uint16_t> sides{0, 1, 2, 0, 2, 3, 0, 4, 5, 0, 5, 1, 1, 5, 6, 1, 6, 2, 2, 6, 7, 2, 7, 3, 3, 7, 4, 3, 4, 0};
    if (!open) sides.insert(sides.end(), {4, 6, 5, 4, 7, 6});
    model.json["materials"] = {nlohmann::json::parse(material)};
    model.addMesh({{"attributes", {{"POSITION", corners}}}, {"indices", model.indices(sides)}, {"material", 0}});
    model.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    model.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, inside ? 0 : 5}}});
    model.json["scenes"][0]["nodes"].push_back(1);
    return loadScene(model.write(Path(testing::TempDir()) / "lodestir_default_light" / "cube.gltf"));
}

// If this fails, models without light are black, or grey where they have light.
TEST(DefaultLight, OpenScenesGetASky) {
    for (const bool inside : {true, false}) {
        const Scene scene = cube(true, inside);
        EXPECT_EQ(scene.environment.type, EnvironmentType::sky);
        EXPECT_TRUE(scene.lights.empty());
    }
    EXPECT_EQ(cube(false, false).environment.type, EnvironmentType::sky);
}

// If this fails, rooms and domes that no sky shines into are black from inside. All sides are 1 to 1.73 away: the lamp makes 1 / d^2 there.
TEST(DefaultLight, ClosedShellsGetALamp) {
    const Scene scene = cube(false, true);
    EXPECT_NE(scene.environment.type, EnvironmentType::sky);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].node, 1u) << "it rides along with the camera";
    EXPECT_GT(scene.lights[0].intensity, 3.1416f);
    EXPECT_LT(scene.lights[0].intensity, 3.1416f * 3);
    EXPECT_EQ(scene.exposure, 0);
}

// If this fails, glass domes are dark, a scene's own light is drowned by the sun, or pictures of baked rooms are lit twice.
TEST(DefaultLight, WhatLightsItselfGetsNone) {
    const Scene glowing = cube(false, true, R"({"emissiveFactor": [1, 1, 1]})");
    EXPECT_TRUE(glowing.lights.empty());
    EXPECT_NE(glowing.environment.type, EnvironmentType::sky);
    const Scene unlit = cube(true, true, R"({"extensions": {"KHR_materials_unlit": {}}})");
    EXPECT_TRUE(unlit.lights.empty());
    EXPECT_NE(unlit.environment.type, EnvironmentType::sky);
    EXPECT_EQ(cube(false, true, R"({"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}})").environment.type,
              EnvironmentType::sky);
}

// If this fails, an unlit floor counts as the light of what stands on it.
TEST(DefaultLight, UnlitSurfacesAreNotTheLightOfOthers) {
    GltfModel model;
    model.addTriangle();
    model.addTriangle();
    model.json["materials"] = {{{"name", "lit"}}, {{"name", "unlit"}, {"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}}}};
    for (int i = 0; i < 2; ++i) model.json["meshes"][std::size_t(i)]["primitives"][0]["material"] = i;
    EXPECT_EQ(loadScene(model.write(Path(testing::TempDir()) / "lodestir_default_light" / "floor.gltf")).environment.type, EnvironmentType::sky);
}

}  // namespace
}  // namespace lodestir
