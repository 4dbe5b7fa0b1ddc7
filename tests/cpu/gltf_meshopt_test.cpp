// SPDX-License-Identifier: MIT
// Compressed buffer views: what the meshoptimizer library packs comes out again, and nonsense is refused with its place.
#include "gltf_model.h"

#include <framework/core/error.h>
#include <framework/scene/gltf/gltf.h>
#include <framework/scene/gltf/meshopt_attributes.h>

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <span>

namespace lodestir {
namespace {

using nlohmann::json;

class Meshopt : public testing::Test {
protected:
    Path folder() const {
        const Path path = Path(testing::TempDir()) / "lodestir_meshopt";
        std::filesystem::create_directories(path);
        return path;
    }

    /// A compressed view of the model; its decoded data would lie in buffer 1, which has no bytes. Returns the view.
    int view(GltfModel& model, const std::vector<unsigned char>& packed, std::size_t count, std::size_t stride, const char* mode,
             const char* filter = "NONE") {
        while (model.bytes().size() % 4) model.bytes().push_back(0);
        const std::size_t offset = model.bytes().size();
        model.bytes().insert(model.bytes().end(), packed.begin(), packed.end());
        model.json["bufferViews"].push_back({{"buffer", 1},
                                             {"byteOffset", fallbackBytes},
                                             {"byteLength", count * stride},
                                             {"extensions",
                                              {{extension,
                                                {{"buffer", 0},
                                                 {"byteOffset", offset},
                                                 {"byteLength", packed.size()},
                                                 {"count", count},
                                                 {"byteStride", stride},
                                                 {"mode", mode},
                                                 {"filter", filter}}}}}});
        if (std::string(mode) == "ATTRIBUTES") model.json["bufferViews"].back()["byteStride"] = stride;
        fallbackBytes += count * stride;
        return static_cast<int>(model.json["bufferViews"].size()) - 1;
    }
    static int accessor(GltfModel& model, int bufferView, int componentType, const char* type, std::size_t count, bool normalized = false) {
        model.json["accessors"].push_back(
            {{"bufferView", bufferView}, {"componentType", componentType}, {"count", count}, {"type", type}, {"normalized", normalized}});
        return static_cast<int>(model.json["accessors"].size()) - 1;
    }
    template <class T> static std::vector<unsigned char> packVertices(const std::vector<T>& values, std::size_t stride) {
        const std::size_t count = values.size() * sizeof(T) / stride;
        std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(count, stride));
        packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), values.data(), count, stride));
        return packed;
    }
    Path write(GltfModel& model) {
        model.json["extensionsUsed"] = model.json["extensionsRequired"] = {extension, "KHR_mesh_quantization"};
        const Path path = model.write(folder() / "packed.gltf");
        model.json["buffers"].push_back({{"byteLength", fallbackBytes}});
        writeFile(path, model.json.dump(1));
        return path;
    }
    std::string refusal(GltfModel& model) {
        try {
            Scene scene;
            loadGltf(write(model), scene, none);
        } catch (const Error& error) {
            return error.what();
        }
        return "it was loaded";
    }

    const char* extension = "EXT_meshopt_compression";
    std::size_t fallbackBytes = 0;
};

const std::vector<float> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

// If this fails, models from gltfpack are shown torn.
TEST_F(Meshopt, GivesBackVerticesAndIndicesOfBothModes) {
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        for (const bool triangles : {true, false}) {
            extension = name;
            fallbackBytes = 0;
            GltfModel model;
            const int positions = accessor(model, view(model, packVertices(square, 12), 4, 12, "ATTRIBUTES"), 5126, "VEC3", 4);
            const std::vector<unsigned> order{0, 1, 2, 0, 2, 3};
            std::vector<unsigned char> packed(1024);
            packed.resize(triangles ? meshopt_encodeIndexBuffer(packed.data(), packed.size(), order.data(), order.size())
                                    : meshopt_encodeIndexSequence(packed.data(), packed.size(), order.data(), order.size()));
            const int indices = accessor(model, view(model, packed, 6, 2, triangles ? "TRIANGLES" : "INDICES"), 5123, "SCALAR", 6);
            model.addMesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
            Scene scene;
            loadGltf(write(model), scene, none);
            const MeshLevel& level = scene.meshes.at(0).levels.at(0);
            ASSERT_EQ(level.triangles.size(), 2u);
            double area = 0;
            for (const glm::uvec3& t : level.triangles)
                area += 0.5 * glm::length(glm::cross(level.positions[t.y] - level.positions[t.x], level.positions[t.z] - level.positions[t.x]));
            EXPECT_NEAR(area, 1, 1e-6);
        }
    }
}

// If this fails, compressed normals and colours are garbage. The filters' inputs are made by their definitions.
TEST_F(Meshopt, AppliesTheFilters) {
    extension = "KHR_meshopt_compression";
    GltfModel model;
    // Exponential: mantissa 3 at 2^-1 is 1.5.
    std::vector<std::int32_t> powers;
    for (const float v : square) powers.push_back(static_cast<std::int32_t>(0xff000000u) | static_cast<std::int32_t>(v * 3));
    const int positions = accessor(model, view(model, packVertices(powers, 12), 4, 12, "ATTRIBUTES", "EXPONENTIAL"), 5126, "VEC3", 4);
    // Octahedral, K = 8: (0.6, 0, 0.8) has x / (|x| + |z|) = 3/7 of 127.
    std::vector<std::int8_t> normals;
    for (int i = 0; i < 4; ++i) normals.insert(normals.end(), {54, 0, 127, 0});
    const int normal = accessor(model, view(model, packVertices(normals, 4), 4, 4, "ATTRIBUTES", "OCTAHEDRAL"), 5120, "VEC3", 4, true);
    // Colour, K = 8: red 100, green 60, blue 20 and alpha 101 are Y 60, Co 40, Cg 0, and 50 below the marking bit.
    std::vector<std::uint8_t> colors;
    for (int i = 0; i < 4; ++i) colors.insert(colors.end(), {60, 40, 0, 128 + 50});
    const int color = accessor(model, view(model, packVertices(colors, 4), 4, 4, "ATTRIBUTES", "COLOR"), 5121, "VEC4", 4, true);
    model.addMesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normal}, {"COLOR_0", color}}}, {"indices", model.indices({0, 1, 2, 0, 2, 3})}});
    Scene scene;
    loadGltf(write(model), scene, none);
    const MeshLevel& level = scene.meshes.at(0).levels.at(0);
    ASSERT_EQ(level.positions.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(level.positions[i], glm::vec3(square[3 * i], square[3 * i + 1], square[3 * i + 2]) * 1.5f);
        EXPECT_LT(glm::length(level.normals[i] - glm::vec3(0.6f, 0, 0.8f)), 0.02f);
        EXPECT_LT(glm::length(level.colors[i] * 255.0f - glm::vec4(100, 60, 20, 100)), 0.01f);
    }
}

// If this fails, models that are packed with newer tools are torn. The stream is written by hand from the extension's text: four elements of
// 16 bytes, one channel of each kind and one whose bytes are stored in each of the ways.
TEST_F(Meshopt, ReadsVersion1OfTheAttributes) {
    extension = "KHR_meshopt_compression";
    const float third = -2.5f;
    const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v); };
    std::vector<unsigned char> stream{0xa1};
    const auto put = [&](std::initializer_list<unsigned> values) {
        for (const unsigned v : values) stream.push_back(static_cast<unsigned char>(v));
    };
    // Controls: channel 0 (XOR) verbatim in all bytes; channel 1 (XOR) zeros; channel 2 (pairs) narrow; channel 3 (bytes) wide.
    put({0xff, 0xaa, 0x00, 0x55});
    // Channel 0: x goes 1 -> 1 -> 3 -> -2.5; the changes are rotated by 4 to the left when stored.
    const std::array<std::uint32_t, 4> changes{0, 0, bits(1) ^ bits(3), bits(3) ^ bits(third)};
    for (unsigned k = 0; k < 4; ++k) {
        for (const std::uint32_t change : changes) put({std::rotl(change, 4) >> 8 * k & 255u});
    }
    // Channel 1 (y) is what the baseline says. Channel 2: pairs 300 -> 301 -> 299 -> 299 -> 599: differences 1, -2, 0, 300 folded are 2, 3, 0, 600.
    put({0x03, 0x23, 0x0f, 0, 0, 0, 0, 0, 0, 88});             // low bytes, 4 bits: 2, 3, 0, and 600 & 255 = 88 behind them
    put({0x01, 0x08, 0x00, 2});                                // high bytes, 1 bit each from below: 0 0 0 1, then the byte: 600 >> 8 = 2
    put({0x00, 0x00});                                         // the second pair: all groups of width 0
    // Channel 3: bytes; 1, 2, 4 and 8 bits wide.
    put({0x00, 0x02, 0x00, 9});                                // 0 *9 0 0: folded 9 is -5
    put({0x01, 0x6c, 0, 0, 0, 7});                             // 1 2 *7 0: -1, 1, -4, 0
    put({0x02, 0x12, 0x34, 0, 0, 0, 0, 0, 0});                 // 1 2 3 4: -1, 1, -2, 2
    put({0x03, 200, 1, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});  // 100, -1, 0, 1
    // Baseline: x 1, y 0.25, pairs 300 and 7, bytes 10 20 30 40; then the channels' modes. 20 bytes, padded to 24 before them.
    put({0, 0, 0, 0});
    for (const std::uint32_t word : {bits(1), bits(0.25f), 300u | 7u << 16, 10u | 20u << 8 | 30u << 16 | 40u << 24})
        for (unsigned k = 0; k < 4; ++k) put({word >> 8 * k & 255u});
    put({0x42, 0x02, 0x01, 0x00});

    const auto decoded = decodeMeshoptVersion1(std::as_bytes(std::span(stream)), 4, 16);
    ASSERT_TRUE(decoded);
    struct Element {
        float x, y;
        std::uint16_t a, b;
        std::array<std::uint8_t, 4> bytes;
    };
    std::array<Element, 4> elements;
    ASSERT_EQ(decoded->size(), sizeof elements);
    std::memcpy(elements.data(), decoded->data(), sizeof elements);
    const std::array<float, 4> x{1, 1, 3, third};
    const std::array<std::uint16_t, 4> a{301, 299, 299, 599};
    const std::array<std::array<std::uint8_t, 4>, 4> last{{{10, 19, 29, 140}, {5, 20, 30, 139}, {5, 16, 28, 139}, {5, 16, 30, 140}}};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(elements[i].x, x[i]);
        EXPECT_EQ(elements[i].y, 0.25f);
        EXPECT_EQ(elements[i].a, a[i]);
        EXPECT_EQ(elements[i].b, 7);
        EXPECT_EQ(elements[i].bytes, last[i]);
    }
    // Nothing is read past its end, whatever is cut off, and nothing may be left over.
    for (std::size_t size = 0; size < stream.size(); ++size) EXPECT_FALSE(decodeMeshoptVersion1(std::as_bytes(std::span(stream).first(size)), 4, 16));
    EXPECT_FALSE(decodeMeshoptVersion1(std::as_bytes(std::span(stream)), 20, 16));
    stream.back() = 0x10;  // a rotation of what isn't rotated
    EXPECT_FALSE(decodeMeshoptVersion1(std::as_bytes(std::span(stream)), 4, 16));
}

// If this fails, a damaged file is read out of bounds or refused without its place.
TEST_F(Meshopt, RefusesWhatCannotBeDecoded) {
    const auto model = [&](const std::function<void(json&)>& spoil, std::vector<unsigned char> packed) {
        GltfModel m;
        fallbackBytes = 0;
        const int positions = accessor(m, view(m, packed, 4, 12, "ATTRIBUTES"), 5126, "VEC3", 4);
        m.addMesh({{"attributes", {{"POSITION", positions}}}});
        spoil(m.json["bufferViews"][0]["extensions"][extension]);
        return m;
    };
    const std::vector<unsigned char> good = packVertices(square, 12);
    const auto expect = [&](const std::function<void(json&)>& spoil, const char* text, const std::vector<unsigned char>& packed) {
        GltfModel m = model(spoil, packed);
        const std::string message = refusal(m);
        EXPECT_NE(message.find(text), std::string::npos) << message;
        EXPECT_NE(message.find("/bufferViews/0/extensions/EXT_meshopt_compression"), std::string::npos) << message;
    };
    expect([](json& e) { e["buffer"] = 7; }, "there is no buffer 7, the file has 2", good);
    expect([](json& e) { e["byteLength"] = 100000; }, "are not all inside buffer 0", good);
    expect([](json& e) { e["mode"] = "QUADS"; }, "there is no mode \"QUADS\"", good);
    expect([](json& e) { e["byteStride"] = 7; }, "cannot be 7 bytes apart", good);
    expect([](json& e) { e["filter"] = "OCTAHEDRAL"; }, "filter OCTAHEDRAL does not go with", good);
    expect([](json& e) { e["count"] = -3; }, "must be a number from 0 on", good);
    expect([](json& e) { e["count"] = 5; }, "are not the view's 48 bytes", good);
    std::vector<unsigned char> bad = good;
    bad.resize(bad.size() / 2);
    expect([](json&) {}, "bytes cannot be decoded", bad);
    bad = good;
    bad[0] = 0xa7;
    expect([](json&) {}, "bytes cannot be decoded", bad);
}

}  // namespace
}  // namespace lodestir
