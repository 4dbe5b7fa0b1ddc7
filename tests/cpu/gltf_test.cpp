// SPDX-License-Identifier: MIT
// glTF models: known answers on small ones made here; nothing read out of bounds.
#include "gltf_model.h"
#include "png_bytes.h"

#include <framework/core/error.h>
#include <framework/scene/gltf/gltf.h>
#include <framework/scene/shading_frame.h>
#include <framework/scene/tangent_space.h>
#include <framework/scene/gltf/uri.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <limits>

namespace lodestir {
namespace {

using nlohmann::json;

Path folder() { return Path(testing::TempDir()) / "lodestir_gltf"; }

Scene load(GltfModel& model) {
    Scene scene;
    loadGltf(model.write(folder() / "model.gltf"), scene, none);
    return scene;
}

/// The message of loading, "" when it loads.
std::string refusal(GltfModel& model) {
    try {
        load(model);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

bool hasNote(const Scene& scene, const std::string& part) {
    for (const std::string& note : scene.notes) {
        if (note.find(part) != std::string::npos) return true;
    }
    return false;
}

void expectNear(const glm::vec3& value, const glm::vec3& expected, float tolerance = 1e-5f) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], expected[i], tolerance) << "component " << i;
}

const std::vector<float> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

// If this fails, references with spaces or letters beyond ASCII, and embedded data, are not found.
TEST(Uri, DecodesPercentSignsAndBase64) {
    EXPECT_EQ(percentDecode("a%20b%2Fc%E2%9D%A4%"), "a b/c\xE2\x9D\xA4%");
    const auto bytes = decodeBase64("TG9kZQ==");
    ASSERT_TRUE(bytes);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()), "Lode");
    EXPECT_TRUE(decodeBase64("")->empty());
    EXPECT_EQ(decodeBase64("TG9kZQ")->size(), 4u);
    EXPECT_FALSE(decodeBase64("TG9k!"));
    EXPECT_FALSE(decodeBase64("TG9kZ"));
}

// If this fails, strips turn every second triangle inside out, or fans miss their centre.
TEST(Uri, FilesAreFoundAsTheyAreWritten) {
    const Path at = folder() / "uri";
    std::filesystem::create_directories(at / "textures");
    const auto write = [&](const char* name) { writeFile(at / name, std::string_view(name)); };
    const auto read = [&](const std::string& uri) {
        const auto bytes = readUri(uri, at);
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    for (const char* name : {"textures/a b.png", "textures/\xC3\xA4%20.png", "back\\slash.png", "back/slash.png", "co:lon.png"}) {
        std::filesystem::create_directories((at / name).parent_path());
        write(name);
    }
    for (const char* uri : {"textures/a b.png", "textures/a%20b.png", "./textures/a%20b.png", "textures\\a b.png", "textures\\a%20b.png",
                            "textures%5Ca%20b.png", "textures%5ca b.png", ".\\textures\\a b.png", "file:textures/a%20b.png"})
        EXPECT_EQ(read(uri), "textures/a b.png") << uri;
    EXPECT_EQ(read("textures/\xC3\xA4%2520.png"), "textures/\xC3\xA4%20.png");
    EXPECT_EQ(read("textures\\\xC3\xA4%20.png"), "textures/\xC3\xA4%20.png") << "as written, where nothing has the decoded name";
    EXPECT_EQ(read("back\\slash.png"), "back\\slash.png") << "a file of the literal name comes first";
    EXPECT_EQ(read("back%5Cslash.png"), "back\\slash.png");
    EXPECT_EQ(read("co:lon.png"), "co:lon.png") << "no scheme: there is such a file";
    const std::string absolute = std::filesystem::absolute(at / "textures/a b.png").string();
    for (const char* scheme : {"", "file://", "FILE:", "file://localhost"})
        EXPECT_EQ(read(scheme + absolute), "textures/a b.png") << scheme;
    EXPECT_EQ(read("DATA:,x%20y"), "x y");
    const auto refusalOf = [&](const std::string& uri) {
        try {
            read(uri);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(refusalOf("no\\such.png").find("no\\such.png\" is missing"), std::string::npos) << "as it was written";
    EXPECT_NE(refusalOf("file:///no/such.png").find("file \"/no/such.png\" is missing"), std::string::npos);
    EXPECT_NE(refusalOf("http://example.org/a.png").find("is a network address"), std::string::npos);
    EXPECT_NE(refusalOf("C:\\Users\\a.png").find("is missing"), std::string::npos) << "a drive is no scheme";
}

TEST(Gltf, TakesStripsAndFansApart) {
    GltfModel model;
    const int p = model.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
    model.addMesh({{"attributes", {{"POSITION", p}, {"NORMAL", p}}}, {"mode", 5}});
    model.addMesh(
        {{"attributes", {{"POSITION", model.positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0})}, {"NORMAL", model.positions(square)}}},
         {"mode", 6}});
    const Scene scene = load(model);
    EXPECT_EQ(scene.meshes[0].levels[0].triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
    EXPECT_EQ(scene.meshes[1].levels[0].triangles, (std::vector<glm::uvec3>{{1, 2, 0}, {2, 3, 0}}));
}

// If this fails, models without normals are shaded by garbage.
TEST(Gltf, MakesFlatNormals) {
    GltfModel model;
    model.addMesh({{"attributes", {{"POSITION", model.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1})}}},
                   {"indices", model.indices({0, 1, 2, 0, 3, 1})}});
    const MeshLevel level = load(model).meshes[0].levels[0];
    ASSERT_EQ(level.positions.size(), 6u);  // split: each face has its own
    expectNear(level.normals[level.triangles[0].x], {0, 0, 1});
    expectNear(level.normals[level.triangles[1].z], {0, 1, 0});
}

// If this fails, zero or infinite normals reach the shaders as NaN.
TEST(Gltf, RepairsBadNormals) {
    GltfModel model;
    const float inf = std::numeric_limits<float>::infinity();
    model.addMesh(
        {{"attributes",
          {{"POSITION", model.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}, {"NORMAL", model.positions({0, 0, 0, 0, 0, inf, 0, 3, 0})}}}});
    const Scene scene = load(model);
    expectNear(scene.meshes[0].levels[0].normals[0], {0, 0, 1});
    expectNear(scene.meshes[0].levels[0].normals[1], {0, 0, 1});
    expectNear(scene.meshes[0].levels[0].normals[2], {0, 1, 0});
    EXPECT_TRUE(hasNote(scene, "normals"));
}

// If this fails, normalised integers, strides or sparse replacements are read wrongly.
TEST(Gltf, ReadsNormalisedInterleavedAndSparse) {
    GltfModel model;
    const int p = model.positions({9, 9, 9, 9, 9, 9, 0, 1, 0});
    const int replaced = model.accessor(std::vector<std::uint8_t>{0, 1}, 5121, "SCALAR", 1), values = model.positions({0, 0, 0, 1, 0, 0});
    model.json["accessors"][static_cast<std::size_t>(p)]["sparse"] = {
        {"count", 2}, {"indices", {{"bufferView", replaced}, {"componentType", 5121}}}, {"values", {{"bufferView", values}}}};
    const int colors = model.accessor(std::vector<std::uint8_t>{255, 0, 51, 0, 0, 255, 0, 0, 255, 255, 255, 0}, 5121, "VEC3", 3, true);
    json& accessor = model.json["accessors"][static_cast<std::size_t>(colors)];
    accessor["count"] = 3;  // three colours of 3 bytes, 4 bytes apart
    model.json["bufferViews"][static_cast<std::size_t>(colors)]["byteStride"] = 4;
    const int uv = model.accessor(std::vector<std::int16_t>{0, 0, 32767, 0, -32768, 16384}, 5122, "VEC2", 2, true);
    model.addMesh({{"attributes",
                    {{"POSITION", p}, {"COLOR_0", colors}, {"TEXCOORD_0", uv}, {"NORMAL", model.positions({0, 0, 1, 0, 0, 1, 0, 0, 1})}}}});
    const MeshLevel level = load(model).meshes[0].levels[0];
    expectNear(level.positions[0], {0, 0, 0});
    expectNear(level.positions[1], {1, 0, 0});
    expectNear(level.positions[2], {0, 1, 0});
    expectNear(glm::vec3(level.colors[0]), {1, 0, 0.2f});
    expectNear(glm::vec3(level.colors[1]), {0, 1, 0});
    expectNear(glm::vec3(level.colors[2]), {1, 1, 1});
    EXPECT_EQ(level.colors[0].a, 1);
    EXPECT_NEAR(level.uv0[1].x, 1, 1e-6);
    EXPECT_NEAR(level.uv0[2].x, -1, 1e-6);
    EXPECT_NEAR(level.uv0[2].y, 0.5, 1e-4);
}

// If this fails, one bad vertex poisons bounds and trees, or a triangle is lost without being counted.
TEST(Gltf, LeavesOutAndCountsBadTriangles) {
    GltfModel model;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    model.addMesh({{"attributes", {{"POSITION", model.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, nan, 0, 0, 2, 0, 0})}}},
                   {"indices", model.indices({0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 0, 2})}});
    const Scene scene = load(model);
    EXPECT_EQ(scene.meshes[0].levels[0].triangles.size(), 1u);
    EXPECT_EQ(scene.droppedTriangles, 3u);
    EXPECT_TRUE(hasNote(scene, "not finite"));
    EXPECT_NEAR(scene.bounds()[1].x, 1, 1e-6);
}

// If this fails, primitives of one mesh lose their materials or attributes when they are merged.
TEST(Gltf, MergesPrimitivesWithTheirMaterials) {
    GltfModel model;
    model.json["materials"] = {{{"name", "a"}}, {{"name", "b"}}};
    const int p = model.positions(square), uv = model.accessor(std::vector<float>{0, 0, 1, 0, 1, 1, 0, 1}, 5126, "VEC2", 2);
    model.addMesh({{"attributes", {{"POSITION", p}, {"NORMAL", p}}}, {"material", 1}, {"indices", model.indices({0, 1, 2})}});
    model.json["meshes"][0]["primitives"].push_back(
        {{"attributes", {{"POSITION", p}, {"NORMAL", p}, {"TEXCOORD_0", uv}}}, {"material", 0}, {"indices", model.indices({0, 2, 3})}});
    model.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", p}}}, {"indices", model.indices({1, 2, 3})}});
    const Scene scene = load(model);
    const MeshLevel& level = scene.meshes[0].levels[0];
    ASSERT_EQ(level.materials.size(), 3u);
    EXPECT_EQ(scene.materials[level.materials[0]].name, "b");
    EXPECT_EQ(scene.materials[level.materials[1]].name, "a");
    EXPECT_EQ(scene.materials[level.materials[2]].name, "default");
    EXPECT_EQ(level.positions.size(), 9u);  // unused vertices are not carried along
    ASSERT_EQ(level.uv0.size(), level.positions.size());
    EXPECT_EQ(level.uv0[0], glm::vec2(0));
    EXPECT_EQ(level.uv0[level.triangles[1].z], glm::vec2(0, 1));
}

// If this fails, things stand at the wrong place.
TEST(Gltf, ComposesTheHierarchy) {
    GltfModel model;
    const int leaf = model.addTriangle();
    model.json["nodes"][static_cast<std::size_t>(leaf)]["translation"] = {1, 0, 0};
    const float h = std::sqrt(0.5f);
    model.json["nodes"].push_back(
        {{"name", "turned"}, {"rotation", {0, 0, h, h}}, {"scale", {2, 2, 2}}, {"children", {leaf}}});  // 1: 90 degrees about +Z
    model.json["nodes"].push_back(
        {{"name", "moved"}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1}}, {"children", {1}}});  // 2
    model.json["scenes"][0]["nodes"] = {2};
    const Scene scene = load(model);
    ASSERT_EQ(scene.nodes.size(), 3u);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) EXPECT_TRUE(scene.nodes[i].parent == none || scene.nodes[i].parent < i);
    const glm::mat4 world = scene.nodeMatrices(0)[scene.instances[0].node];
    expectNear(glm::vec3(world * glm::vec4(0, 0, 0, 1)), {10, 22, 30});
    expectNear(glm::vec3(world * glm::vec4(1, 0, 0, 1)), {10, 24, 30});
    expectNear(glm::vec3(world * glm::vec4(0, 1, 0, 1)), {8, 22, 30});
}

// If this fails, a level of detail stands beside its mesh, or in its place.
TEST(Gltf, BuildsChainsFromNodeLevels) {
    GltfModel model;
    const int fine =
        model.addMesh({{"attributes", {{"POSITION", model.positions(square)}}}, {"indices", model.indices({0, 1, 2, 0, 2, 3})}});
    const int coarse = model.addTriangle();
    model.json["scenes"][0]["nodes"] = {fine, coarse};  // listed though it should not be
    model.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {coarse};
    model.json["nodes"][0]["extras"]["lod_error"] = {0, 0.25};
    model.json["nodes"][0]["translation"] = {5, 0, 0};
    model.json["nodes"][1]["translation"] = {5, 1, 0};  // one up, relative to the finest
    model.json["extensionsUsed"] = {"MSFT_lod"};
    const Scene scene = load(model);
    ASSERT_EQ(scene.instances.size(), 1u);
    ASSERT_EQ(scene.meshes[0].levels.size(), 2u);
    EXPECT_EQ(scene.meshes[0].levels[0].triangles.size(), 2u);
    EXPECT_EQ(scene.meshes[0].levels[1].triangles.size(), 1u);
    EXPECT_FLOAT_EQ(scene.meshes[0].levels[1].error, 0.25f);
    expectNear(scene.meshes[0].levels[1].positions[0], {0, 1, 0});
}

// If this fails, levels whose file says nothing of their errors are taken for as good as the finest, and shown from the nearest. The coarse one lacks a corner
// of the square that is sqrt(2) / 2 from what is left.
TEST(Gltf, MeasuresLevelsThatBringNoErrors) {
    GltfModel model;
    const int fine =
        model.addMesh({{"attributes", {{"POSITION", model.positions(square)}}}, {"indices", model.indices({0, 1, 2, 0, 2, 3})}});
    const int coarse = model.addMesh({{"attributes", {{"POSITION", model.positions(square)}}}, {"indices", model.indices({0, 1, 2})}});
    model.json["scenes"][0]["nodes"] = {fine};
    model.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {coarse};
    model.json["extensionsUsed"] = {"MSFT_lod"};
    const Scene scene = load(model);
    ASSERT_EQ(scene.meshes[0].levels.size(), 2u);
    EXPECT_NEAR(scene.meshes[0].levels[1].error, std::sqrt(0.5f), 1e-6f);
    EXPECT_TRUE(std::ranges::any_of(scene.notes, [](const std::string& note) { return note.find("measured now") != note.npos; }));
}

// If this fails, two nodes of one mesh store its triangles twice.
TEST(Gltf, SharesMeshesBetweenNodes) {
    GltfModel model;
    model.addTriangle();
    model.json["nodes"].push_back({{"mesh", 0}, {"name", "second"}});
    model.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = load(model);
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[1].name, "second");
}

// If this fails, EXT_mesh_gpu_instancing shows one thing instead of many.
TEST(Gltf, PlacesGpuInstances) {
    GltfModel model;
    model.addTriangle();
    model.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", model.positions({1, 0, 0, 0, 2, 0})},
                                                                                     {"SCALE", model.positions({1, 1, 1, 3, 3, 3})}};
    const Scene scene = load(model);
    ASSERT_EQ(scene.instances.size(), 2u);
    expectNear(glm::vec3(scene.nodeMatrices(0)[scene.instances[1].node] * glm::vec4(1, 0, 0, 1)), {3, 2, 0});
}

// If this fails, normal maps are lit from the wrong side. The picture's u runs along +X, its v (downwards) along -Y.
TEST(Gltf, MakesTangentsAndSplitsMirroredVertices) {
    MeshLevel level;
    level.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
    level.normals.assign(6, {0, 0, 1});
    level.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}, {0, 1}, {0, 0}};  // the right square shows the picture mirrored
    level.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
    makeTangents(level, {});
    ASSERT_EQ(level.positions.size(), 8u);  // vertices 1 and 2 are split
    for (const glm::vec4 t : {level.tangents[0], level.tangents[1]}) {
        expectNear(glm::vec3(t), {1, 0, 0});
        EXPECT_EQ(t.w, 1);
    }
    for (const std::uint32_t v : {level.triangles[2].x, level.triangles[2].y}) {
        expectNear(glm::vec3(level.tangents[v]), {-1, 0, 0});
        EXPECT_EQ(level.tangents[v].w, -1);
    }
}

/// A fan around vertex 0 at the origin of the plane z = 0, with these texture coordinates.
MeshLevel fan(const std::vector<glm::vec2>& points, const std::vector<glm::vec2>& uvs, const std::vector<glm::uvec3>& triangles) {
    MeshLevel level;
    for (const glm::vec2& p : points) level.positions.emplace_back(p, 0);
    level.normals.assign(points.size(), {0, 0, 1});
    level.uv0 = uvs;
    level.triangles = triangles;
    return level;
}

// If this fails, baked normal maps show seams: tangents are means weighted by the angle at the corner, not by area or count.
TEST(Gltf, WeighsTangentsByTheirAngles) {
    // Around the origin 90 degrees whose u runs along +X, then 45 degrees of a far larger triangle whose u runs elsewhere.
    MeshLevel same = fan({{0, 0}, {1, 0}, {0, 1}, {-50, 50}}, {{0, 1}, {1, 1}, {0, 0}, {-1, 0}}, {{0, 1, 2}, {0, 2, 3}});
    makeTangents(same, {});
    // e = (0,1), f = (-50,50); s = (0,-1), r = (-1,-1): along = ((0,-1) - (50,-50)) = (-50, 49) times the sign of area -1: (50, -49).
    const glm::vec2 expected = glm::normalize(2.0f * glm::vec2(1, 0) + 1.0f * glm::normalize(glm::vec2(50, -49)));
    EXPECT_EQ(same.positions.size(), 4u);
    expectNear(glm::vec3(same.tangents[0]), {expected.x, expected.y, 0}, 1e-4f);
}

// If this fails, models whose exporter repeats vertices along edges look faceted, and a triangle without texture area tears its neighbours.
TEST(Gltf, JoinsTangentsOfEqualVerticesAndOverFlatTriangles) {
    // Two triangles that share an edge by position only; u turns by 90 degrees between them.
    const std::vector<glm::vec2> points{{0, 0}, {1, 0}, {0, 1}, {0, 0}, {0, 1}, {-1, 0}};
    const std::vector<glm::vec2> uvs{{0, 1}, {1, 1}, {0, 0}, {0, 1}, {0, 0}, {-1, 1}};
    MeshLevel level = fan(points, uvs, {{0, 1, 2}, {3, 4, 5}});
    makeTangents(level, {});
    EXPECT_EQ(level.tangents[0], level.tangents[3]);
    EXPECT_EQ(level.tangents[2], level.tangents[4]);

    // A strip of three; the middle one has one texture coordinate for all corners. It takes the tangents that are there.
    MeshLevel strip = fan({{0, 0}, {1, 0}, {0, 1}, {1, 1}}, {{0, 0}, {0, 0}, {0, 0}, {0, 0}}, {{0, 1, 2}, {1, 3, 2}});
    strip.uv0[0] = {0, 1};
    strip.uv0[1] = {1, 1};
    strip.uv0[2] = {0, 0};
    strip.uv0[3] = {0.5f, 0.5f};  // on the line between 1 and 2: no area
    makeTangents(strip, {});
    EXPECT_EQ(strip.positions.size(), 4u);
    for (std::size_t v = 0; v < 3; ++v) expectNear(glm::vec3(strip.tangents[v]), {1, 0, 0});
    EXPECT_EQ(strip.tangents[1].w, 1);
}

// If this fails, rotated textures turn the wrong way. The numbers are those of Khronos' TextureTransformTest: the arrow's tip is at
// uv (0.778, 0.778) of the picture; turned by 22.5 degrees it must be seen at (0.421, 1.016), not at (1.016, 0.421).
TEST(Gltf, TransformsTextureCoordinates) {
    const glm::vec2 uv = transformUv({.rotation = 0.39269908f}, {0.5f - 0.0790482f, 0.5f + 0.5162675f});
    EXPECT_NEAR(uv.x, 0.5 + 0.2778175, 1e-4);
    EXPECT_NEAR(uv.y, 0.5 + 0.2778175, 1e-4);
    const glm::vec2 scaled = transformUv({.offset = {0.25f, -1}, .scale = {2, 3}}, {1, 1});
    EXPECT_NEAR(scaled.x, 2.25, 1e-6);
    EXPECT_NEAR(scaled.y, 2, 1e-6);
}

// If this fails, textures of 16 bits are off by a step of 8 bits, or silently lose what they have more.
TEST(Gltf, RoundsTexturesOfSixteenBitsAndSaysSo) {
    GltfModel model;
    const std::string pixels{0, 1, '\xff', '\xfe', 0};  // a row of one pixel: grey and opacity
    std::filesystem::create_directories(folder());
    writeFile(folder() / "wide.png", pngFile({{"IHDR", pngHeader(1, 16, 4)}, {"IDAT", stored(pixels)}}));
    model.json["images"] = {{{"uri", "wide.png"}}};
    model.json["textures"] = {{{"source", 0}}};
    model.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    model.addTriangle();
    const Scene scene = load(model);
    EXPECT_EQ(scene.textures.at(0).rgba, (std::vector<std::uint8_t>{2, 2, 2, 253}));
    EXPECT_TRUE(hasNote(scene, "16 bits"));
}

// If this fails, glass, lamps and cut-outs look like plaster.
TEST(Gltf, ReadsMaterialExtensions) {
    GltfModel model;
    model.addTriangle();
    model.json["materials"] = {
        {{"name", "glass"},
         {"emissiveFactor", {1, 0.5, 0}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.3},
         {"doubleSided", true},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 0.9}}},
           {"KHR_materials_ior", {{"ior", 1.33}}},
           {"KHR_materials_dispersion", json::object()},
           {"KHR_materials_volume", {{"thicknessFactor", 0.1}, {"attenuationDistance", 2}, {"attenuationColor", {0.5, 1, 1}}}}}}}};
    model.json["extensionsUsed"] = {"KHR_materials_dispersion", "KHR_materials_iridescence", "KHR_materials_ior"};
    const Scene scene = load(model);
    const Material& glass = scene.materials[0];
    expectNear(glass.emission, {4, 2, 0});
    EXPECT_EQ(glass.alphaMode, AlphaMode::mask);
    EXPECT_FLOAT_EQ(glass.alphaCutoff, 0.3f);
    EXPECT_TRUE(glass.doubleSided);
    EXPECT_FLOAT_EQ(glass.transmission, 0.9f);
    EXPECT_FLOAT_EQ(glass.ior, 1.33f);
    EXPECT_TRUE(glass.solid);
    EXPECT_FLOAT_EQ(glass.attenuationDistance, 2);
    EXPECT_TRUE(hasNote(scene, "ignored: KHR_materials_dispersion, KHR_materials_iridescence"));
    EXPECT_FALSE(glass.layers);
}

// If this fails, lacquer, cloth and brushed metal look like plastic, or plain materials pay for them.
TEST(Gltf, ReadsMaterialLayers) {
    GltfModel model;
    model.addTriangle();
    model.json["materials"] = {
        {{"extensions",
          {{"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {2, 1, 0}}}},
           {"KHR_materials_sheen", {{"sheenColorFactor", {0.1, 0.2, 3}}, {"sheenRoughnessFactor", 0.4}}},
           {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.6}, {"anisotropyRotation", 1.5}}},
           {"KHR_materials_clearcoat", {{"clearcoatFactor", 0.7}, {"clearcoatRoughnessFactor", -1}}}}}},
        {{"extensions",
          {{"KHR_materials_specular", json::object()},
           {"KHR_materials_sheen", json::object()},
           {"KHR_materials_anisotropy", json::object()},
           {"KHR_materials_clearcoat", {{"clearcoatRoughnessFactor", 0.5}}}}}}};
    const Scene scene = load(model);
    ASSERT_TRUE(scene.materials[0].layers);
    const MaterialLayers& layers = *scene.materials[0].layers;
    EXPECT_FLOAT_EQ(layers.specular, 0.5f);
    expectNear(layers.specularColor, {2, 1, 0});
    expectNear(layers.sheenColor, {0.1f, 0.2f, 1});
    EXPECT_FLOAT_EQ(layers.sheenRoughness, 0.4f);
    EXPECT_FLOAT_EQ(layers.anisotropy, 0.6f);
    EXPECT_FLOAT_EQ(layers.anisotropyRotation, 1.5f);
    EXPECT_FLOAT_EQ(layers.coat, 0.7f);
    EXPECT_FLOAT_EQ(layers.coatRoughness, 0);
    EXPECT_FALSE(scene.materials[1].layers);
}

// If this fails, baked rooms are lit twice.
TEST(Gltf, UnlitMaterialsEmitTheirBaseColour) {
    GltfModel model;
    model.addTriangle();
    model.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.25, 0.5, 1, 0.5}}}},
                                {"alphaMode", "BLEND"},
                                {"emissiveFactor", {1, 1, 1}},
                                {"extensions", {{"KHR_materials_unlit", json::object()}, {"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}}}}};
    const Scene scene = load(model);
    const Material& m = scene.materials[0];
    EXPECT_TRUE(m.unlit);
    expectNear(m.emission, {0.25f, 0.5f, 1});
    EXPECT_EQ(m.baseColor, glm::vec4(0, 0, 0, 0.5f));
    EXPECT_EQ(m.ior, 1);  // no reflection either
    EXPECT_FALSE(m.layers);
}

// If this fails, lights shine elsewhere and the camera of the file isn't used.
TEST(Gltf, ReadsLightsAndTheFirstCamera) {
    GltfModel model;
    model.addTriangle();
    model.json["extensionsUsed"] = {"KHR_lights_punctual"};
    model.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"color", {1, 0, 0}}, {"intensity", 7}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}}};
    model.json["cameras"] = {{{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 0}, {"znear", 0.1}, {"zfar", 9}}}},
                             {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    model.json["nodes"].push_back({{"camera", 0}});
    model.json["nodes"].push_back({{"camera", 1}, {"translation", {0, 0, 4}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    model.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = loadScene(model.write(folder() / "camera.gltf"));
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].type, LightType::spot);
    EXPECT_FLOAT_EQ(scene.lights[0].outerCone, 0.2f);
    EXPECT_TRUE(hasNote(scene, "has a height of 0; it is ignored"));
    const CameraKey camera = scene.cameraAt(0);
    EXPECT_FLOAT_EQ(camera.fovy, 0.5f);
    expectNear(camera.position, {0, 0, 4});
    expectNear(glm::normalize(camera.target - camera.position), {0, 0, -1});
    EXPECT_NEAR(camera.focus, 4, 1e-4);  // the triangle is in focus
}

// If this fails, drawings show twice or half of what they should: xmag and ymag are halves of width and height.
TEST(Gltf, ReadsOrthographicCameras) {
    GltfModel model;
    model.addTriangle();
    model.json["cameras"] = {{{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 1.25}, {"znear", 0.1}, {"zfar", 9}}}}};
    model.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 4}}, {"scale", {3, 3, 0}}});
    model.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = loadScene(model.write(folder() / "camera.gltf"));
    const CameraKey camera = scene.cameraAt(0);
    EXPECT_FLOAT_EQ(camera.height, 2.5f);
    expectNear(camera.position, {0, 0, 4});
    expectNear(glm::normalize(camera.target - camera.position), {0, 0, -1});  // though the node is flat
}

struct Damage {
    const char* what;
    void (*apply)(GltfModel&);
    const char* expected;
};

// If one of these fails, a broken file crashes the program or is believed. Each expected text holds the JSON pointer.
TEST(Gltf, RefusesWhatWouldBeReadOutOfBounds) {
    const Damage damages[] = {
        {"index past the vertices",
         [](GltfModel& m) {
             m.addMesh({{"attributes", {{"POSITION", m.positions(square)}}}, {"indices", m.indices({0, 1, 4})}});
         },
         "/meshes/0/primitives/0/indices: index 4 (at 2 of 3) is past the 4 vertices"},
        {"no such accessor",
         [](GltfModel& m) {
             m.addMesh({{"attributes", {{"POSITION", 9}}}});
         },
         "/meshes/0/primitives/0/attributes/POSITION: there is no accessor 9"},
        {"count past the view",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["accessors"][0]["count"] = 4;
         },
         "/accessors/0: 4 elements of 12 bytes"},
        {"count that overflows",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["accessors"][0]["count"] = 0x1555555555555557;
         },
         "/accessors/0"},
        {"offset past the view",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["accessors"][0]["byteOffset"] = 40;
         },
         "from byte 40 on leave"},
        {"view past the buffer",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["bufferViews"][0]["byteOffset"] = 4;
         },
         "/bufferViews/0: bytes 4 to 40"},
        {"view of no buffer",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["bufferViews"][0]["buffer"] = 3;
         },
         "/bufferViews/0/buffer: there is no buffer 3"},
        {"no such view",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["accessors"][0]["bufferView"] = 7;
         },
         "/bufferViews/7: there is no buffer view 7"},
        {"stride below the element",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["bufferViews"][0]["byteStride"] = 8;
         },
         "stride of 8"},
        {"attributes of different counts",
         [](GltfModel& m) {
             m.addMesh({{"attributes", {{"POSITION", m.positions(square)}, {"NORMAL", m.positions({0, 0, 1})}}}});
         },
         "NORMAL has 1 elements, POSITION has 4"},
        {"float indices",
         [](GltfModel& m) {
             const int p = m.positions(square);
             m.addMesh({{"attributes", {{"POSITION", p}}}, {"indices", m.accessor(std::vector<float>{0, 1, 2}, 5126, "SCALAR", 1)}});
         },
         "indices must be unsigned"},
        {"no such mesh",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["nodes"][0]["mesh"] = 5;
         },
         "/nodes/0/mesh: there is no mesh 5"},
        {"cycle",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["nodes"].push_back({{"children", {2}}});
             m.json["nodes"].push_back({{"children", {1}}});
         },
         "among its own descendants"},
        {"two parents",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["nodes"].push_back({{"children", {0}}});
             m.json["nodes"].push_back({{"children", {0}}});
         },
         "/nodes/2/children/0: node 0 is a child of node 1 too"},
        {"no such child",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["nodes"][0]["children"] = {8};
         },
         "/nodes/0/children/0: there is no node 8"},
        {"level of itself",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {0};
         },
         "coarser level of itself"},
        {"required extension",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["extensionsRequired"] = {"KHR_draco_mesh_compression", "X_y"};
         },
         "the model needs extension KHR_draco_mesh_compression, which is not supported"},
        {"old version",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["asset"]["version"] = "1.0";
         },
         "glTF version \"1.0\" is not supported"},
        {"newer version needed",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["asset"]["minVersion"] = "2.1";
         },
         "it needs glTF 2.1"},
        {"translation beyond all floats",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["nodes"][0]["translation"] = {0, 1e300, 0};
         },
         "/nodes/0/translation: 1e+300 is too large a number"},
        {"instances without data",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["accessors"].push_back({{"componentType", 5126}, {"count", 1000000}, {"type", "VEC3"}});
             m.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", 1}};
         },
         "TRANSLATION: the attribute has no data"},
        {"sparse index past the count",
         [](GltfModel& m) {
             m.addTriangle();
             const int i = m.accessor(std::vector<std::uint8_t>{3}, 5121, "SCALAR", 1), v = m.positions({0, 0, 0});
             m.json["accessors"][0]["sparse"] = {
                 {"count", 1}, {"indices", {{"bufferView", i}, {"componentType", 5121}}}, {"values", {{"bufferView", v}}}};
         },
         "sparse index 3 is past the 3 elements"},
        {"zeros without end",
         [](GltfModel& m) {
             m.addTriangle();
             m.json["accessors"][0].erase("bufferView");
             m.json["accessors"][0]["count"] = 1000000000000;
         },
         "too many to be meant"},
    };
    for (const Damage& damage : damages) {
        GltfModel model;
        damage.apply(model);
        EXPECT_NE(refusal(model).find(damage.expected), std::string::npos) << damage.what << " gave: " << refusal(model);
    }
}

void useImage(GltfModel& m, const std::string& uri) {
    m.json["images"] = {{{"uri", uri}}};
    m.json["textures"] = {{{"source", 0}}};
    m.json["materials"][0] = {{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}};
}

// If one of these fails, a model is not shown because of something that it can be shown without, or nobody is told what is missing.
TEST(Gltf, LeavesOutWhatAModelCanBeShownWithout) {
    const auto punctual = [](GltfModel& m, json lights, int used) {
        m.json["extensions"]["KHR_lights_punctual"]["lights"] = std::move(lights);
        m.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = used;
    };
    const std::pair<const char*, std::function<void(GltfModel&)>> damages[] = {
        {"there is no material 2, the file has 0", [](GltfModel& m) { m.json["meshes"][0]["primitives"][0]["material"] = 2; }},
        {"there is no texture 1, the file has 0", [](GltfModel& m) { m.json["materials"][0]["normalTexture"]["index"] = 1; }},
        {"there is no image 3, the file has 0",
         [](GltfModel& m) {
             m.json["textures"] = {{{"source", 3}}};
             m.json["materials"][0]["normalTexture"]["index"] = 0;
         }},
        {"there is no sampler 4, the file has 0",
         [](GltfModel& m) {
             useImage(m, "none.png");
             m.json["textures"][0]["sampler"] = 4;
         }},
        {"\"GLASS\" is no alpha mode", [](GltfModel& m) { m.json["materials"][0]["alphaMode"] = "GLASS"; }},
        {"baseColorFactor has 3 numbers, not 4",
         [](GltfModel& m) {
             m.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1};
         }},
        {"image 0 is left out: file", [](GltfModel& m) { useImage(m, "no%20such.png"); }},
        {"no such.png\" is missing", [](GltfModel& m) { useImage(m, "no%20such.png"); }},
        {"aaa\" is missing", [](GltfModel& m) { useImage(m, std::string(300, 'a')); }},
        {"is a network address", [](GltfModel& m) { useImage(m, "https://example.org/a.png"); }},
        {"image 0 is left out: the image is neither PNG nor JPEG", [](GltfModel& m) { useImage(m, "data:,BM rest"); }},
        {"it ends in the middle of a chunk",
         [](GltfModel& m) {  // a chunk of a gigabyte
             useImage(m, "data:,%89PNG%0D%0A%1A%0A%00%00%00%0DIHDR%00%00%00%01%00%00%00%01%08%02%00%00%00%90wS%DE%40%00%00%00IDATx");
         }},
        {"claims 16000x16000 texels, more than its 17 bytes can hold",
         [](GltfModel& m) {  // start of image, then a baseline frame of 16000 x 16000 with one component
             useImage(m, "data:,%FF%D8%FF%C0%00%0B%08%3E%80%3E%80%01%01%11%00%FF%D9");
         }},
        {"there is no camera 2, the file has 0", [](GltfModel& m) { m.json["nodes"][0]["camera"] = 2; }},
        {"there is no skin 2, the file has 0",
         [](GltfModel& m) {
             m.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = m.accessor(std::vector<std::uint8_t>(12, 0), 5121, "VEC4", 4);
             m.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = m.accessor(std::vector<float>(12, 1), 5126, "VEC4", 4);
             m.json["nodes"][0]["skin"] = 2;
         }},
        {"there is no light 7, the file has 1",
         [&](GltfModel& m) {
             punctual(m, {{{"type", "point"}}}, 7);
         }},
        {"light 0 is left out: /extensions/KHR_lights_punctual/lights/0/type: there is no light type \"area\"",
         [&](GltfModel& m) {
             punctual(m, {{{"type", "area"}}}, 0);
         }},
        {"light 0 is left out",
         [&](GltfModel& m) {
             punctual(m, {{{"type", "point"}, {"color", {1, 1}}}}, 0);
         }},
        {"lights/0/intensity: 1e+300 is too large a number",
         [&](GltfModel& m) {
             punctual(m, {{{"type", "point"}, {"intensity", 1e300}}}, 0);
         }},
        {"primitives of mode 9, which there is none of, are left out",
         [](GltfModel& m) {
             json primitive = m.json["meshes"][0]["primitives"][0];
             primitive["mode"] = 9;
             m.json["meshes"][0]["primitives"].push_back(primitive);
         }},
        {"has a zero quaternion",
         [](GltfModel& m) {
             m.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
         }},
        {"has 0 morph targets and 2 weights",
         [](GltfModel& m) {
             m.json["meshes"][0]["weights"] = {1, 2};
         }},
        // What the parser of the structure refuses.
        {"its cameras are left out, which are not as the format demands",
         [](GltfModel& m) {
             m.json["cameras"] = {{{"type", "wide"}}};
         }},
        {"its animations are left out",
         [](GltfModel& m) {
             m.json["animations"] = {{{"channels", {{{"sampler", "x"}}}}, {"samplers", {{{"input", "y"}}}}}};
         }},
        {"its animations, cameras, skins, lights are left out",
         [](GltfModel& m) {
             m.json["cameras"] = {{{"type", "wide"}}};
             m.json["animations"] = {{{"channels", {{{"sampler", "x"}}}}, {"samplers", {{{"input", "y"}}}}}};
         }},
    };
    for (const auto& [expected, damage] : damages) {
        GltfModel model;
        model.addTriangle();
        model.json["materials"] = json::array();
        damage(model);
        if (!model.json["materials"].empty()) model.json["meshes"][0]["primitives"][0]["material"] = 0;
        const std::string refused = refusal(model);
        EXPECT_EQ(refused, "") << expected;
        if (!refused.empty()) continue;
        const Scene scene = load(model);
        ASSERT_EQ(scene.meshes.size(), 1u) << expected;
        EXPECT_EQ(scene.meshes[0].levels[0].triangles.size(), 1u) << expected;
        EXPECT_FALSE(scene.meshes[0].deforms()) << expected;
        EXPECT_TRUE(scene.lights.empty()) << expected;
        for (const Material& material : scene.materials) {
            EXPECT_EQ(material.emissiveMap.texture, none) << expected;
            EXPECT_EQ(material.emission, glm::vec3(0)) << expected << ": all of it would shine";
        }
        std::string notes;
        for (const std::string& note : scene.notes) notes += note + "\n";
        EXPECT_NE(notes.find(expected), std::string::npos) << expected << " is not among the notes:\n" << notes;
    }
}

// If this fails, one number too few costs a material all that stands behind it, or a camera without what nobody reads is lost.
TEST(Gltf, MendsWhatItsParserRefuses) {
    GltfModel model;
    model.addTriangle();
    model.json["materials"] = {{{"emissiveFactor", {1, 0.5, 0.25, 1}},
                                {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 0.125}}, {"roughnessFactor", 0.25}}}}};
    model.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}}}}};
    model.json["nodes"][0]["camera"] = 0;
    model.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}}};
    model.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    const Scene scene = load(model);
    expectNear(glm::vec3(scene.materials[0].baseColor), {0.5f, 0.25f, 0.125f});
    EXPECT_EQ(scene.materials[0].baseColor.a, 1);
    EXPECT_EQ(scene.materials[0].roughness, 0.25f);
    expectNear(scene.materials[0].emission, {1, 0.5f, 0.25f});
    ASSERT_EQ(scene.camera.keys.size(), 1u);
    EXPECT_FLOAT_EQ(scene.camera.keys[0].fovy, 0.5f);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_FLOAT_EQ(scene.lights[0].outerCone, 0.7853982f) << "a quarter of pi, unless the file says otherwise";
}

// If this fails, an unlit picture that is missing turns what it was on black.
TEST(Gltf, UnlitMaterialsWithoutTheirImageKeepTheirColour) {
    GltfModel model;
    model.addTriangle();
    useImage(model, "none.png");
    model.json["materials"][0] = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"baseColorFactor", {0.5, 1, 0.25, 1}}}},
                                  {"extensions", {{"KHR_materials_unlit", json::object()}}}};
    const Scene scene = load(model);
    expectNear(scene.materials[0].emission, {0.5f, 1, 0.25f});
    EXPECT_EQ(scene.materials[0].emissiveMap.texture, none);
}

// If this fails, numbers that JSON has and floats have not make a whole image infinite or not a number.
TEST(Gltf, NumbersBeyondAllFloatsAreDefaults) {
    GltfModel model;
    model.addTriangle();
    model.json["materials"] = {{{"emissiveFactor", {1e300, 1, 1}},
                                {"normalTexture", {{"index", 0}, {"scale", 1e300}}},
                                {"extensions", {{"KHR_materials_specular", {{"specularColorFactor", {1e300, 1, 1}}}}}}}};
    const Scene scene = load(model);
    EXPECT_EQ(scene.materials[0].emission, glm::vec3(0, 1, 1));
    EXPECT_EQ(scene.materials[0].normalScale, 1);
    EXPECT_FALSE(scene.materials[0].layers) << "white, which does nothing";

    GltfModel many;
    many.addTriangle();
    const int places = many.positions({1, 2, 3, std::numeric_limits<float>::infinity(), 0, 0});
    many.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", places}};
    const Scene instances = load(many);
    EXPECT_EQ(instances.instances.size(), 1u);
    EXPECT_TRUE(hasNote(instances, "instances with numbers that are not finite"));
}

// If this fails, files are refused for something that nobody uses or that means nothing; the official validator accepts all of these.
TEST(Gltf, ForgivesWhatIsHarmless) {
    GltfModel model;
    model.addTriangle();
    model.json["accessors"][0]["count"] = 3.0;
    model.json["accessors"].push_back({{"componentType", 5126}, {"count", 2}, {"type", "VEC9"}});
    model.json["accessors"].push_back({{"componentType", 5126}, {"count", 1 << 20}, {"type", "VEC3"}});
    model.json["accessors"].push_back({{"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}});
    model.addMesh({{"attributes", {{"POSITION", 2}}}});                  // all in one place
    model.addMesh({{"attributes", {{"POSITION", 0}}}, {"indices", 3}});  // all of one vertex
    const Scene scene = load(model);
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].levels[0].triangles.size(), 1u);

    GltfModel user;
    user.json["accessors"].push_back({{"componentType", 5126}, {"count", 2}, {"type", "VEC9"}});
    user.addMesh({{"attributes", {{"POSITION", 0}}}});
    EXPECT_NE(refusal(user).find("/accessors/0/type: elements of this type cannot be used here"), std::string::npos) << refusal(user);
}

// If this fails, people mend one mistake at a time and do not learn where it is.
TEST(Gltf, ReportsAllProblemsWithTheirPlaces) {
    GltfModel model;
    model.addMesh({{"attributes", {{"POSITION", 9}}}});
    model.addMesh({{"attributes", {{"POSITION", 8}}}});
    try {
        load(model);
        FAIL() << "it was loaded";
    } catch (const Error& error) {
        ASSERT_EQ(error.problems().size(), 2u);
        EXPECT_GT(error.problems()[0].where.line, 1);
        EXPECT_LT(error.problems()[0].where.line, error.problems()[1].where.line);
    }
}

// If this fails, a damaged file crashes, hangs or reads foreign memory (the last is seen by the sanitizer build): digits and
// letters of a model with all kinds of accessors are changed at random, seed fixed. Each variant loads or gives an Error.
TEST(Gltf, SurvivesRandomDamage) {
    GltfModel model;
    model.addMesh(
        {{"attributes",
          {{"POSITION", model.positions(square)}, {"COLOR_0", model.accessor(std::vector<std::uint8_t>(16, 99), 5121, "VEC4", 4, true)}}},
         {"indices", model.indices({0, 1, 2, 0, 2, 3})},
         {"material", 0}});
    model.addTriangle();
    const int replaced = model.accessor(std::vector<std::uint8_t>{1}, 5121, "SCALAR", 1), values = model.positions({2, 0, 0});
    model.json["accessors"][0]["sparse"] = {
        {"count", 1}, {"indices", {{"bufferView", replaced}, {"componentType", 5121}}}, {"values", {{"bufferView", values}}}};
    model.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {1};
    model.json["nodes"].push_back({{"children", {0}}, {"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    model.json["scenes"][0]["nodes"] = {2};
    model.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    model.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    model.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 1}}}}}};
    model.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}}}},
         {"samplers",
          {{{"input", model.accessor(std::vector<float>{0, 1}, 5126, "SCALAR", 1)}, {"output", model.positions({0, 0, 0, 1, 1, 1})}}}}}};
    const std::string whole = readText(model.write(folder() / "whole.gltf"));
    std::uint32_t state = 12345;
    const auto random = [&](std::size_t bound) {
        state = state * 1664525u + 1013904223u;
        return static_cast<std::size_t>(state >> 8) % bound;
    };
    std::size_t loaded = 0;
    constexpr int variants = 400;
    for (int i = 0; i < variants; ++i) {
        std::string text = whole;
        for (std::size_t changed = 0; changed < 3;) {
            char& c = text[random(text.size())];
            if (!std::isdigit(static_cast<unsigned char>(c))) continue;
            c = static_cast<char>('0' + random(10));
            ++changed;
        }
        writeFile(folder() / "damaged.gltf", text);
        try {
            Scene scene;
            loadGltf(folder() / "damaged.gltf", scene, none);
            for (const Mesh& mesh : scene.meshes) {
                for (const glm::uvec3& t : mesh.levels[0].triangles) ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.levels[0].positions.size());
            }
            scene.nodeMatrices(7);
            ++loaded;
        } catch (const Error&) {}
    }
    EXPECT_GT(loaded, 0u);
    EXPECT_LT(loaded, std::size_t(variants));
}

// If this fails, a folder cloned without git-lfs is called damaged instead of unfetched.
TEST(Gltf, NamesGitLfsPointers) {
    GltfModel model;
    model.addTriangle();
    model.bytes().clear();
    model.json["buffers"] = {{{"byteLength", 36}, {"uri", "data.bin"}}};
    writeFile(folder() / "data.bin", std::string_view("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 36\n"));
    EXPECT_NE(refusal(model).find("data.bin: is a git-lfs pointer, not the file itself"), std::string::npos) << refusal(model);
}

}  // namespace
}  // namespace lodestir
