// SPDX-License-Identifier: MIT
// `lodestir lod`: what is written is read back, all else of the model stays, and bad input leaves no file.
#include "../temporary_folder.h"
#include "gltf_model.h"
#include "lod_surface.h"
#include "printed.h"

#include <framework/app/commands/commands.h>
#include <framework/core/error.h>
#include <framework/core/json.h>
#include <framework/scene/gltf/gltf.h>
#include <framework/scene/gltf/file.h>
#include <framework/scene/lod/model.h>

#include <gtest/gtest.h>

#include <cstdlib>

namespace lodestir {
namespace {

using nlohmann::json;

class LodCommand : public test::FolderTest {
protected:
    /// A primitive with the surface's positions, UVs (if asked for) and triangles.
    json primitive(const MeshLevel& surface, bool withUvs = true) {
        std::vector<float> positions, uvs;
        std::vector<std::uint16_t> indices;
        for (const glm::vec3& p : surface.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
        for (const glm::vec2& uv : surface.uv0) uvs.insert(uvs.end(), {uv.x, uv.y});
        for (const glm::uvec3& t : surface.triangles)
            for (int k = 0; k < 3; ++k) indices.push_back(std::uint16_t(t[k]));
        json result = {{"attributes", {{"POSITION", model.positions(positions)}}}, {"indices", model.indices(indices)}};
        if (withUvs) result["attributes"]["TEXCOORD_0"] = model.accessor(uvs, 5126, "VEC2", 2);
        return result;
    }
    /// A hilly sheet of 512 triangles as mesh "hills" of node 0.
    void addHills() {
        const MeshLevel sheet =
            gridSurface(16, 16, [](float u, float v) { return glm::vec3(2 * u, 0.1f * std::sin(7 * u) * std::cos(5 * v), 2 * v); });
        model.addMesh(primitive(sheet));
        model.json["meshes"][0]["name"] = "hills";
    }
    Path write() { return model.write(folder / "model.gltf"); }

    std::string lod(std::vector<std::string> arguments) { return printed(addLod, "lod", std::move(arguments)); }
    std::string in() const { return (folder / "model.gltf").string(); }
    std::string out() const { return (folder / "out.glb").string(); }
    Scene load() const {
        Scene scene;
        loadGltf(out(), scene, none);
        return scene;
    }

    GltfModel model;
};

// If this fails, levels, errors or coverages of the file are not those that were measured.
TEST_F(LodCommand, WhatIsWrittenIsReadBack) {
    addHills();
    write();
    const Json facts = Json::parse(lod({in(), "--levels", "3", "--ratio", "4", "--out", out(), "--json"}), "stdout");
    const std::vector<Json>& levels = facts.find("meshes")->items()[0].find("levels")->items();
    ASSERT_EQ(levels.size(), 3u);
    const Scene scene = load();
    ASSERT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.meshes[0].levels.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
        const MeshLevel& level = scene.meshes[0].levels[k];
        EXPECT_EQ(std::int64_t(level.triangles.size()), levels[k].find("triangles")->asInt());
        EXPECT_FLOAT_EQ(level.error, float(levels[k].find("error")->asNumber()));
        EXPECT_FLOAT_EQ(level.coverage, float(levels[k].find("coverage")->asNumber()));
        EXPECT_EQ(level.uv0.size(), level.positions.size());
    }
    EXPECT_LE(scene.meshes[0].levels[1].triangles.size(), 128u);
    EXPECT_LE(scene.meshes[0].levels[2].triangles.size(), 32u);
    EXPECT_GT(scene.meshes[0].levels[1].error, 0);
    EXPECT_GT(scene.meshes[0].levels[2].error, scene.meshes[0].levels[1].error);
    EXPECT_EQ(scene.meshes[0].levels[2].coverage, 0);
    EXPECT_GT(scene.meshes[0].levels[0].coverage, scene.meshes[0].levels[1].coverage);
    EXPECT_NE(lod({in(), "--out", out()}).find("level 3: "), std::string::npos) << "four levels are the default";
}

// If this fails, nodes of one mesh get levels of their own, or stand elsewhere.
TEST_F(LodCommand, NodesShareLevelsAndKeepTheirPlaces) {
    addHills();
    model.json["nodes"][0]["name"] = "first";
    model.json["nodes"].push_back({{"mesh", 0},
                                   {"name", "turned"},
                                   {"translation", {1, 2, 3}},
                                   {"rotation", {0.1826, 0.3651, 0.5477, 0.7303}},
                                   {"scale", {0.3, 0.7, 1.1}},
                                   {"extras", {{"kept", 5}}}});
    model.json["nodes"].push_back({{"children", {1}}, {"matrix", {0.6, 0.8, 0, 0, -0.8, 0.6, 0, 0, 0, 0, 1.7, 0, 9, 8, 7, 1}}});
    model.json["scenes"][0]["nodes"] = {0, 2};
    Scene before;
    loadGltf(write(), before, none);
    lod({in(), "--out", out(), "--levels", "3"});
    const Scene after = load();
    ASSERT_EQ(after.meshes.size(), 1u) << "levels are stored once";
    EXPECT_EQ(after.meshes[0].levels.size(), 3u);
    ASSERT_EQ(after.instances.size(), 2u);
    EXPECT_EQ(after.nodes.size(), before.nodes.size());
    const auto matrices = after.nodeMatrices(0), expected = before.nodeMatrices(0);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(after.instances[i].name, before.instances[i].name);
        EXPECT_EQ(matrices[after.instances[i].node], expected[before.instances[i].node]);
    }
    EXPECT_EQ(readGltfFile(out()).model.nodes[1].extras.Get("kept").GetNumberAsInt(), 5);
}

// If this fails, a model that is shown without an image gets no levels because of it.
TEST_F(LodCommand, AnImageThatIsMissingStaysAName) {
    addHills();
    model.json["images"] = {{{"uri", "no%20such.png"}}};
    model.json["textures"] = {{{"source", 0}}};
    model.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    const LodModel made = buildLodModel(model.write(folder / "model.gltf"), {});
    EXPECT_TRUE(std::ranges::any_of(made.notes, [](const std::string& note) { return note.starts_with("image 0 stays a name: file"); }));
    writeFile(folder / "made.glb", made.glb);
    EXPECT_EQ(readGltfFile(folder / "made.glb").json.find("images")->items()[0].find("uri")->asString(), "no%20such.png");
}

// If this fails, a model loses something on its way.
TEST_F(LodCommand, AllElseStays) {
    addHills();
    const unsigned char png[] = {0x89, 'P',  'N',  'G', 0x0d, 0x0a, 0x1a, 0x0a, 0,    0,    0,    13,   'I',  'H',  'D',  'R', 0, 0,
                                 0,    1,    0,    0,   0,    1,    8,    2,    0,    0,    0,    0x90, 0x77, 0x53, 0xde, 0,   0, 0,
                                 12,   'I',  'D',  'A', 'T',  8,    0xd7, 0x63, 0xf8, 0xcf, 0xc0, 0,    0,    3,    1,    1,   0, 0x18,
                                 0xdd, 0x8d, 0xb0, 0,   0,    0,    0,    'I',  'E',  'N',  'D',  0xae, 0x42, 0x60, 0x82};
    writeFile(folder / "red.png", std::as_bytes(std::span(png)));
    model.json["images"] = {{{"uri", "red.png"}}};
    model.json["textures"] = {{{"source", 0}}};
    model.json["materials"] = {{{"name", "red"},
                                {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"roughnessFactor", 0.37}}},
                                {"extensions", {{"MSFT_lod", {{"ids", {1}}}}}}},
                               {{"name", "lamp"}, {"emissiveFactor", {1, 1, 0.5}}}};
    model.json["meshes"][0]["primitives"][0]["material"] = 0;
    const MeshLevel globe = octahedralSphere(3);
    json lamp = primitive(globe, false), plain = lamp;
    lamp["material"] = 1;
    model.addMesh(lamp);
    model.addMesh(plain);
    model.addTriangle();
    const char* names[] = {"hills", "lamp", "globe", "triangle"};
    for (std::size_t m = 0; m < 4; ++m) model.json["meshes"][m]["name"] = names[m];
    model.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    model.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 40}, {"name", "bulb"}}};
    model.json["extensionsUsed"] = {"KHR_lights_punctual", "MSFT_lod"};
    model.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
         {"samplers",
          {{{"input", model.accessor(std::vector<float>{0, 2}, 5126, "SCALAR", 1)}, {"output", model.positions({0, 0, 0, 1, 1, 1})}}}}}};
    Scene before;
    loadGltf(write(), before, none);
    const std::string text = lod({in(), "--out", out(), "--levels", "3"});
    std::filesystem::remove(folder / "red.png");
    const Scene after = load();
    ASSERT_EQ(after.textures.size(), 1u);
    EXPECT_EQ(after.textures[0].rgba, before.textures[0].rgba);
    ASSERT_EQ(after.materials.size(), before.materials.size());
    EXPECT_FLOAT_EQ(after.materials[0].roughness, 0.37f);
    ASSERT_EQ(after.lights.size(), 1u);
    EXPECT_EQ(after.lights[0].name, "bulb");
    ASSERT_EQ(after.animation.size(), 1u);
    EXPECT_EQ(after.animationLength, before.animationLength);
    ASSERT_EQ(after.meshes.size(), 4u);
    for (std::size_t m = 0; m < 4; ++m) {
        EXPECT_EQ(after.meshes[m].name, names[m]);
        EXPECT_EQ(after.meshes[m].levels.size(), m < 3 ? 3u : 1u) << names[m];
        EXPECT_EQ(after.meshes[m].levels[0].positions, before.meshes[m].levels[0].positions);
        EXPECT_EQ(after.meshes[m].levels[0].triangles, before.meshes[m].levels[0].triangles);
    }
    for (const MeshLevel& level : after.meshes[0].levels) EXPECT_EQ(level.materials[0], 0u);
    EXPECT_NE(text.find("has no UVs"), std::string::npos) << text;
    EXPECT_NE(text.find("1 instead of 3 levels: 1 triangle is too few"), std::string::npos) << text;
    EXPECT_NE(text.find("levels of materials are kept"), std::string::npos) << text;
}

/// A ball's primitive with colours: red where x < 0, else blue, in bytes.
json colored(GltfModel& model, const MeshLevel& ball, json primitive) {
    std::vector<std::uint8_t> colors;
    for (const glm::vec3& p : ball.positions)
        for (const int c : {p.x < 0 ? 255 : 0, 0, p.x < 0 ? 0 : 255, 255}) colors.push_back(std::uint8_t(c));
    primitive["attributes"]["COLOR_0"] = model.accessor(colors, 5121, "VEC4", 4, true);
    return primitive;
}

// If this fails, a scan (unlit, with vertex colours) gets no levels, or levels of another colour.
TEST_F(LodCommand, UnlitAndColouredMeshesGetLevels) {
    const MeshLevel ball = octahedralSphere(4);
    model.json["materials"] = {{{"extensions", {{"KHR_materials_unlit", json::object()}}}, {"emissiveFactor", {1, 1, 1}}}};
    json primitive = colored(model, ball, this->primitive(ball, false));
    primitive["material"] = 0;
    model.addMesh(primitive);
    write();
    const Json facts = Json::parse(lod({in(), "--out", out(), "--json"}), "stdout");
    const std::vector<Json>& levels = facts.find("meshes")->items()[0].find("levels")->items();
    ASSERT_EQ(levels.size(), 4u);
    const Scene scene = load();
    ASSERT_EQ(scene.meshes[0].levels.size(), 4u);
    const auto redness = [](const MeshLevel& level) {
        double red = 0, total = 0;
        for (const glm::uvec3& t : level.triangles) {
            const double area = glm::length(glm::cross(level.positions[t.y] - level.positions[t.x], level.positions[t.z] - level.positions[t.x]));
            red += area * (level.colors[t.x].r + level.colors[t.y].r + level.colors[t.z].r) / 3;
            total += area;
        }
        return red / total;
    };
    for (std::size_t k = 1; k < 4; ++k) {
        EXPECT_NEAR(redness(scene.meshes[0].levels[k]), redness(scene.meshes[0].levels[0]), 0.01) << k;
        EXPECT_GE(levels[k].find("error")->asNumber(), levels[k].find("appearance")->asNumber());
        EXPECT_GT(levels[k].find("appearance")->asNumber(), 0);
    }
}

// Of a mesh whose last part is unlit: normals are fitted where they are seen, and those that aren't stay what they were.
TEST_F(LodCommand, NormalsOfUnlitPartsStay) {
    MeshLevel ball = octahedralSphere(4);
    model.json["materials"] = {json::object(), {{"extensions", {{"KHR_materials_unlit", json::object()}}}}};
    json parts = json::array();
    for (int material = 0; material < 2; ++material) {
        std::vector<float> normals;
        for (glm::vec3& p : ball.positions) {
            normals.insert(normals.end(), {p.x, p.y, p.z});
            p.x += 3 * float(material);  // beside the other
        }
        json part = primitive(ball, false);
        part["attributes"]["NORMAL"] = model.accessor(normals, 5126, "VEC3", 3);
        part["material"] = material;
        parts.push_back(part);
    }
    model.addMesh(parts[0]);
    model.json["meshes"][0]["primitives"] = parts;
    write();
    lod({in(), "--out", out(), "--json"});
    const GltfFile file = readGltfFile(out());
    ASSERT_GT(file.model.meshes.size(), 1u);
    for (std::size_t level = 1; level < file.model.meshes.size(); ++level) {
        ASSERT_EQ(file.model.meshes[level].primitives.size(), 2u);
        for (std::size_t p = 0; p < 2; ++p) {
            const int own = file.model.meshes[0].primitives[p].attributes.at("NORMAL"), made = file.model.meshes[level].primitives[p].attributes.at("NORMAL");
            EXPECT_EQ(own == made, p == 1) << "level " << level << ", part " << p;
        }
    }
}

TEST_F(LodCommand, SaysThatADeformingMeshIsMeasuredAtRest) {
    const MeshLevel ball = octahedralSphere(3);
    json primitive = this->primitive(ball, false);
    std::vector<float> moved;
    for (const glm::vec3& p : ball.positions) moved.insert(moved.end(), {0.1f * p.x, 0, 0});
    primitive["targets"] = {{{"POSITION", model.positions(moved)}}};
    model.addMesh(primitive);
    model.json["meshes"][0]["weights"] = {0};
    write();
    EXPECT_NE(lod({in(), "--out", out()}).find("it deforms: its levels are made and measured as the file has it at rest"), std::string::npos);
    const Scene scene = load();
    ASSERT_GT(scene.meshes[0].levels.size(), 1u);
    for (const MeshLevel& level : scene.meshes[0].levels) ASSERT_EQ(level.targets.size(), 1u);
}

// If this fails, the only copy of a model is gone after a typing mistake.
TEST_F(LodCommand, TheModelItselfIsKept) {
    addHills();
    write();
    lod({in(), "--out", out()});
    const std::vector<std::byte> before = readBytes(out());
    std::filesystem::create_symlink(out(), folder / "link.glb");
    for (const std::string& name : {out(), (folder / "link.glb").string(), (folder / "." / "out.glb").string()})
        try {
            lod({out(), "--out", name});
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("--out is the model itself; name another file, or write over it with --force"), std::string::npos)
                << error.what();
        }
    EXPECT_EQ(readBytes(out()), before);
}

// A file that went through once goes through again and keeps its chains.
TEST_F(LodCommand, LevelsThatAreThereAreKept) {
    addHills();
    write();
    lod({in(), "--out", out(), "--levels", "3"});
    const std::vector<std::byte> once = readBytes(out());
    testing::internal::CaptureStderr();
    EXPECT_NE(lod({out(), "--out", out(), "--levels", "5", "--force"}).find("1 node has levels already and keeps them"), std::string::npos);
    EXPECT_NE(testing::internal::GetCapturedStderr().find("no mesh got any levels"), std::string::npos);
    EXPECT_EQ(load().meshes[0].levels.size(), 3u);
    EXPECT_EQ(readBytes(out()), once);
}

TEST_F(LodCommand, TheSameFileEveryTime) {
    addHills();
    write();
    lod({in(), "--out", out()});
    const std::vector<std::byte> once = readBytes(out());
    lod({in(), "--out", out()});
    EXPECT_EQ(readBytes(out()), once);
}

TEST_F(LodCommand, WrongUseAndWrongFilesLeaveNothing) {
    addHills();
    write();
    const auto refusal = [&](const std::vector<std::string>& arguments) {
        try {
            lod(arguments);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THROW(lod({in()}), CLI::ParseError);
    EXPECT_THROW(lod({in(), "--out", "out.gltf"}), CLI::ParseError);
    EXPECT_THROW(lod({in(), "--out", out(), "--levels", "1"}), CLI::ParseError);
    EXPECT_THROW(lod({in(), "--out", out(), "--levels", "9"}), CLI::ParseError);
    EXPECT_THROW(lod({in(), "--out", out(), "--ratio", "3"}), CLI::ParseError);
    EXPECT_NE(refusal({in(), "--out", out(), "--mesh", "hils"}).find("there is no mesh \"hils\"; did you mean \"hills\"?"),
              std::string::npos);
    EXPECT_NE(refusal({(folder / "none.glb").string(), "--out", out()}).find("none.glb"), std::string::npos);
    writeFile(folder / "cut.glb", "glTF\2");
    EXPECT_NE(refusal({(folder / "cut.glb").string(), "--out", out()}).find("not a valid GLB file"), std::string::npos);
    // A mesh that only a node outside the scene shows is not loaded, but would be simplified.
    model.json["meshes"].push_back(model.json["meshes"][0]);
    model.json["meshes"][1]["primitives"][0]["indices"] = model.indices({0, 1, 999});
    model.json["nodes"].push_back({{"mesh", 1}});
    write();
    EXPECT_NE(refusal({in(), "--out", out()}).find("/meshes/1/primitives/0/indices: an index is past the 289 vertices"), std::string::npos);
    model.json["nodes"][1]["mesh"] = 7;
    write();
    EXPECT_NE(refusal({in(), "--out", out()}).find("/nodes/1/mesh: there is no mesh 7"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(out()));
}

}  // namespace
}  // namespace lodestir
