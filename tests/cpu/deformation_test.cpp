// SPDX-License-Identifier: MIT
// Skins and morph targets: vertices go where the format says, and the hierarchy of boxes follows them.
#include "gltf_model.h"
#include "triangle_soup.h"

#include <framework/core/error.h>
#include <framework/scene/deformation.h>
#include <framework/scene/upload/geometry.h>
#include <framework/scene/gltf/gltf.h>
#include <framework/scene/scene_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace lodestir {
namespace {

Path file(const std::string& name) { return Path(testing::TempDir()) / "lodestir_deformation" / name; }

Scene load(GltfModel& model, const std::string& name) {
    Scene scene;
    loadGltf(model.write(file(name + ".gltf")), scene, none);
    return scene;
}

void expectNear(glm::vec3 value, glm::vec3 expected, float tolerance = 1e-5f) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], expected[i], tolerance) << "component " << i;
}

/// A triangle with two morph targets at weights 0.5 and 0, the first of which is animated from 0 to 1 in a second.
GltfModel morphing() {
    GltfModel model;
    const int base = model.positions({0, 0, 0, 1, 0, 0, 0, 1, 0}), up = model.positions({0, 0, 2, 0, 0, 2, 0, 0, 2});
    const int wide = model.positions({0, 0, 0, 3, 0, 0, 0, 0, 0});
    model.addMesh({{"attributes", {{"POSITION", base}}}, {"targets", {{{"POSITION", up}}, {{"POSITION", wide}}}}});
    model.json["meshes"][0]["weights"] = {0.5, 0.0};
    return model;
}

// If this fails, morph targets are not the sum of weighted displacements.
TEST(Deformation, TargetsAdd) {
    GltfModel model = morphing();
    const Scene scene = load(model, "targets");
    ASSERT_TRUE(scene.deforms());
    expectNear(deform(scene, 0, 0, poseAt(scene, 0)).positions[1], {1, 0, 1});
    const PosedVertices both = deform(scene.meshes[0].levels[0], std::vector<float>{-1, 0.5f}, {});
    expectNear(both.positions[0], {0, 0, -2});
    expectNear(both.positions[1], {2.5f, 0, -2});
}

// If this fails, weights are read in the wrong order: keys come first, targets within a key.
TEST(Deformation, WeightsAreAnimated) {
    GltfModel model = morphing();
    const int times = model.accessor(std::vector<float>{0, 1}, 5126, "SCALAR", 1);
    const int weights = model.accessor(std::vector<float>{0, 0, 1, 0.5f}, 5126, "SCALAR", 1);
    model.json["animations"] = {{{"samplers", {{{"input", times}, {"output", weights}}}},
                                 {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
    const Scene scene = load(model, "weights");
    const auto at = scene.morphWeights(15);  // half a second
    ASSERT_EQ(at.size(), 1u);
    EXPECT_NEAR(at[0][0], 0.5f, 1e-5f);
    EXPECT_NEAR(at[0][1], 0.25f, 1e-5f);
    expectNear(deform(scene, 0, 0, poseAt(scene, 15)).positions[1], {1.75f, 0, 1});
}

// If this fails, the normals of a mesh without any stay those of its rest pose: the triangle tips from +Z to where its corner rises.
TEST(Deformation, FlatNormalsFollowTheFaces) {
    GltfModel model;
    const int base = model.positions({0, 0, 0, 1, 0, 0, 0, 1, 0}), corner = model.positions({0, 0, 0, 0, 0, 1, 0, 0, 0});
    model.addMesh({{"attributes", {{"POSITION", base}}}, {"targets", {{{"POSITION", corner}}}}});
    model.json["meshes"][0]["weights"] = {1.0};
    const Scene scene = load(model, "flat");
    const float h = std::sqrt(0.5f);
    for (const glm::vec3& normal : deform(scene, 0, 0, poseAt(scene, 0)).normals) expectNear(normal, {-h, 0, h});
}

/// A strip from (0,0) to (0,2) whose upper end follows the second of two joints, its middle both; `sum` is what weights sum to.
GltfModel bending(float sum) {
    GltfModel model;
    const int positions = model.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0});
    const int joints = model.accessor(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, 5121, "VEC4", 4);
    const float s = sum, h = 0.5f * sum;
    const int weights = model.accessor(std::vector<float>{s, 0, 0, 0, s, 0, 0, 0, h, h, 0, 0, h, h, 0, 0, 0, s, 0, 0, 0, s, 0, 0}, 5126, "VEC4", 4);
    const int indices = model.indices({0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5});
    const int node = model.addMesh({{"attributes", {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}, {"indices", indices}});
    // The second joint stands at (0,1,0); its inverse bind matrix takes that to the origin.
    const int inverse =
        model.accessor(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1}, 5126, "MAT4", 16);
    const float half = std::sqrt(0.5f);
    model.json["nodes"].push_back({{"name", "lower"}, {"translation", {0, 0, 5}}, {"children", {2}}});
    model.json["nodes"].push_back({{"name", "upper"}, {"translation", {0, 1, 0}}, {"rotation", {0, 0, half, half}}});
    model.json["scenes"][0]["nodes"].push_back(1);
    model.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", inverse}}};
    model.json["nodes"][std::size_t(node)]["skin"] = 0;
    model.json["nodes"][std::size_t(node)]["translation"] = {100, 0, 0};  // a skinned mesh doesn't heed its own node
    return model;
}

void expectBent(const std::vector<glm::vec3>& p, glm::vec3 shift = glm::vec3(0)) {
    ASSERT_EQ(p.size(), 12u);  // flat: three for each triangle
    expectNear(p[0], glm::vec3(0, 0, 5) + shift);
    expectNear(p[1], glm::vec3(1, 0, 5) + shift);
    expectNear(p[5], glm::vec3(0.5f, 1.5f, 5) + shift);   // (1,1): half of (1,1) and half of a quarter turn about (0,1), (0,2)
    expectNear(p[8], glm::vec3(-1, 1, 5) + shift);        // (0,2) turned about (0,1)
    expectNear(p[11], glm::vec3(-1, 2, 5) + shift);
}

// If this fails, characters explode or stand beside themselves.
TEST(Deformation, JointsBlend) {
    for (const float sum : {1.0f, 0.25f}) {  // not every file's weights sum to 1
        GltfModel model = bending(sum);
        const Scene scene = load(model, "skin");
        const Pose pose = poseAt(scene, 0);
        expectBent(deform(scene, 0, 0, pose).positions);
        EXPECT_EQ(scene.instanceMatrix(scene.instances[0], pose.nodes), glm::mat4(1));
        const auto bounds = scene.bounds();
        expectNear(bounds[0], {-1, 0, 5});
        expectNear(bounds[1], {1, 2, 5});
    }
}

// If this fails, the second of two placements of a character moves with the first.
TEST(Deformation, RepeatedModelsHavePosesOfTheirOwn) {
    GltfModel model = bending(1);
    model.write(file("repeated.gltf"));
    writeFile(file("repeated.json"), std::string(R"({"format": 1, "models": {"man": {"file": "repeated.gltf"}}, "instances": [
        {"model": "man"}, {"model": "man", "translation": [0, 0, 7]}]})"));
    const Scene scene = loadScene(file("repeated.json"));
    ASSERT_EQ(scene.instances.size(), 2u);
    ASSERT_NE(scene.instances[0].mesh, scene.instances[1].mesh);
    const Pose pose = poseAt(scene, 0);
    expectBent(deform(scene, scene.instances[0].mesh, 0, pose).positions);
    expectBent(deform(scene, scene.instances[1].mesh, 0, pose).positions, {0, 0, 7});
}

// If this fails, a model is not shown because of its skin, or stands deformed by half of it.
TEST(Deformation, WrongSkinsAreLeftOut) {
    const auto notesOf = [](bool deforms, const std::function<void(nlohmann::json&)>& damage) {
        GltfModel model = bending(1);
        damage(model.json);
        const Scene scene = load(model, "wrong");
        EXPECT_EQ(scene.meshes.at(0).skin != none, deforms);
        EXPECT_EQ(scene.meshes[0].deforms(), deforms);
        std::string notes;
        for (const std::string& note : scene.notes) notes += note + "\n";
        return notes;
    };
    EXPECT_NE(notesOf(false, [](auto& json) { json["nodes"][0]["skin"] = 4; }).find("there is no skin 4"), std::string::npos);
    EXPECT_NE(notesOf(false, [](auto& json) { json["skins"][0]["joints"] = nlohmann::json::array(); }).find("left out"), std::string::npos);
    EXPECT_NE(notesOf(false, [](auto& json) { json["skins"][0]["joints"][0] = 17; }).find("there is no node 17"), std::string::npos);
    EXPECT_NE(notesOf(false, [](auto& json) { json["skins"][0]["inverseBindMatrices"] = 0; }).find("expected 4x4 matrices"),
              std::string::npos);
    EXPECT_NE(notesOf(false, [](auto& json) { json["scenes"][0]["nodes"] = {0}; }).find("is not in the scene"), std::string::npos);
    // A joint that isn't there takes no vertex along; those that are share its weight.
    EXPECT_NE(notesOf(true, [](auto& json) { json["skins"][0]["joints"] = {1}; }).find("follow joints that skin 0 has not"),
              std::string::npos);
    GltfModel model = bending(1);
    model.json["skins"][0]["joints"] = {1};
    const Scene scene = load(model, "fewer");
    for (const VertexJoints& v : scene.meshes[0].levels[0].joints) {
        EXPECT_NEAR(std::accumulate(v.weights.begin(), v.weights.end(), 0.0f), 1, 1e-6);
        EXPECT_EQ(*std::ranges::max_element(v.joints), 0);
    }
}

// If this fails, rays miss what has moved: arrays that a pose was fitted to must equal, triangle by triangle, those of a mesh that was
// built where the pose puts it, and each box must hold what is below it.
TEST(Deformation, GeometryFollowsThePose) {
    const test::Soup soup = test::randomSoup(5, 400, 0.2f);
    Scene scene;
    scene.materials.push_back({});
    scene.nodes.push_back({});
    MeshLevel level{.positions = soup.positions, .triangles = soup.triangles};
    level.normals.assign(level.positions.size(), {0, 0, 1});
    level.materials.assign(level.triangles.size(), 0);
    MorphTarget target;
    test::Draws draws(9);
    for (std::size_t i = 0; i < level.positions.size(); ++i) target.positions.push_back(draws.point(-3, 3));
    level.targets.push_back(target);
    scene.meshes.push_back({.name = "soup", .levels = {level}, .weights = {0.0f}, .node = 0});
    scene.instances.push_back({"soup", 0, 0});

    Geometry geometry(scene);
    for (const float weight : {1.0f, -0.5f, 0.0f}) {
        geometry.pose(scene, {scene.nodeMatrices(0), {{weight}}});
        const BvhGrid grid = geometry.grids[0];
        for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
            const PrimitiveRecord& corners = geometry.primitives.values()[t];
            const glm::vec3 v0 = soup.positions[corners.v0] + weight * target.positions[corners.v0];
            const glm::vec3 v1 = soup.positions[corners.v1] + weight * target.positions[corners.v1];
            expectNear(grid.origin() + grid.scale * geometry.triangles.values()[t].v0, v0, 1e-4f);
            expectNear(grid.scale * geometry.triangles.values()[t].e1, v1 - v0, 1e-4f);
        }
        std::size_t leaves = 0;
        const std::function<Box(std::uint32_t)> content = [&](std::uint32_t reference) {
            Box box;
            const auto add = [&](glm::vec3 low, glm::vec3 high) { box = {glm::min(box.low, low), glm::max(box.high, high)}; };
            if (reference >= bvh_ref::leaf) {
                const std::uint32_t first = reference & (bvh_ref::masked - 1), count = (reference >> 28 & 3) + 1;
                leaves += count;
                for (std::uint32_t t = first; t < first + count; ++t) {
                    const BvhTriangle& triangle = geometry.triangles.values()[t];
                    const glm::vec3 v0 = triangle.v0 - grid.boxes();  // boxes count from the grid's base
                    for (const glm::vec3& p : {v0, v0 + triangle.e1, v0 + triangle.e2}) add(p, p);
                }
                return box;
            }
            const BvhNode& node = geometry.nodes[reference];
            for (std::size_t i = 0; i < 4; ++i) {
                const std::uint32_t child = node.dwords[2 * (4 + i) + 1];
                if (child == bvh_ref::empty) continue;
                const glm::uvec3 packed(node.dwords[2 * i], node.dwords[2 * (4 + i)], node.dwords[2 * i + 1]);
                const glm::vec3 low(packed & 0xffffu), high(packed >> 16u);
                const Box below = content(child);
                EXPECT_TRUE(glm::all(glm::lessThanEqual(low, below.low)) && glm::all(glm::greaterThanEqual(high, below.high)));
                EXPECT_LE(glm::length(below.low - low) + glm::length(high - below.high), 8.0f) << "a box is wider than its content";
                add(below.low, below.high);
            }
            return box;
        };
        content(geometry.roots[0]);
        EXPECT_EQ(leaves, soup.triangles.size());
    }
}

}  // namespace
}  // namespace lodestir
