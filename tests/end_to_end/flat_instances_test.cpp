// SPDX-License-Identifier: MIT
// Objects that their nodes squeeze flat are seen, shine and move as sheets do; those squeezed to a line or a point are not there.
#include "model.h"
#include "program.h"
#include "render.h"

namespace lodestir::test {
namespace {

class FlatInstances : public ProgramTest {
protected:
    /// Puts the model's mesh under nodes, one below the other.
    void hang(const std::string& name, const std::vector<OrderedJson>& nodes, const OrderedJson& more = OrderedJson::object()) {
        OrderedJson gltf = OrderedJson::parse(readText(folder / (name + ".gltf")));
        gltf["nodes"] = OrderedJson::array();
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            OrderedJson node = nodes[i];
            if (i + 1 < nodes.size())
                node["children"] = {i + 1};
            else
                node["mesh"] = 0;
            gltf["nodes"].push_back(node);
        }
        gltf.update(more);
        writeFile(folder / (name + ".gltf"), gltf.dump());
    }
    std::vector<ImageData> trace(const std::string& name, int frames, const OrderedJson& parameters, const std::string& rays = {}) {
        return render(writeGraph(folder, name, 17, 17, parameters), "trace", frames, {}, rays);
    }
    const std::vector<Quad> cube = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, {.color = Point(0), .emission = Point(0.5)});
    const OrderedJson exact{{"spp", 1}, {"bounces", 0}, {"film", "centre"}};
};

// Its lit faces look outwards on both sides, so it isn't seen through from any, with every way to trace.
TEST_F(FlatInstances, AreSeenFromBothSides) {
    const std::vector<std::vector<OrderedJson>> hangings{
        {{{"scale", {2, 1, 0}}}},
        {{{"scale", {2, 1, 0}}}, {{"rotation", {0.2, 0.4, 0.4, 0.8}}}},  // turned, then squeezed
        {{{"scale", {3, 3, 1e-9}}}, {{"translation", {0, 0.1, 5}}}},
        {{{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0.3, 0.2, 0, 0, 0, 0, 0, 1}}}},  // depth becomes a shift
        {{{"translation", {0, 0, -1000}}}, {{"translation", {0, 0, 1000}}, {"scale", {-2, 2, 0}}}},
    };
    for (std::size_t i = 0; i < hangings.size(); ++i) {
        for (const double side : {-1.0, 1.0}) {
            writeModel(folder, "flat", cube);
            hang("flat", hangings[i]);
            writeScene(folder, "flat", {{0.2, 0.3, side * 6}, {0, 0, 0}, {0, 1, 0}, 60}, constantEnvironment(Point(0)));
            for (const char* rays : {"packet", "lane", "ray_query"}) {
                SCOPED_TRACE(fmt::format("hanging {}, side {}, {}", i, side, rays));
                const std::vector<ImageData> images = trace("flat", 1, exact, rays);
                ASSERT_EQ(images.size(), 1u);
                EXPECT_EQ(images[0].at(8, 8, 0), 0.5f);
                for (const int x : {0, 16})
                    for (const int y : {0, 16}) EXPECT_EQ(images[0].at(x, y, 0), 0);
                for (const float v : images[0].values) EXPECT_TRUE(v == 0 || v == 0.5f || v == 1) << v;  // 1: alpha
            }
        }
    }
}

TEST_F(FlatInstances, WithoutAreaAreNotThere) {
    for (const std::vector<double>& scale : {std::vector<double>{1, 0, 0}, {0, 0, 0}, {0, 3, 0}}) {
        writeModel(folder, "gone", cube);
        hang("gone", {{{"rotation", {0.2, 0.4, 0.4, 0.8}}, {"scale", scale}}, {{"rotation", {0.4, 0.2, 0.4, 0.8}}}});
        writeScene(folder, "gone", {{0.2, 0.3, 6}}, constantEnvironment(Point(0.25)));
        for (const char* rays : {"packet", "lane", "ray_query"}) {
            const std::vector<ImageData> images = trace("gone", 1, {{"spp", 4}, {"bounces", 2}}, rays);
            ASSERT_EQ(images.size(), 1u);
            for (const float v : images[0].values) EXPECT_TRUE(v == 0.25f || v == 1) << v;
        }
    }
}

// Half of a flat lamp's area shines down: as much as from a sheet.
TEST_F(FlatInstances, LampsShineLikeSheets) {
    const Paint floor{.color = Point(0.8)};
    const auto lit = [&](bool flat, const char* estimator) {
        const std::vector<Quad> ground{{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, floor}};
        writeModel(folder, "ground", ground);
        writeModel(folder, "lamp",
                   flat ? box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, {.color = Point(0), .emission = Point(4)})
                        : std::vector<Quad>{{{-0.5, 0, -0.5}, {1, 0, 0}, {0, 0, 1}, {.color = Point(0), .emission = Point(4)}}});
        hang("lamp", {{{"translation", {0.1, 1, 0}}, {"scale", {1, flat ? 0 : 1, 1}}}});
        write("lamp.json", {{"format", 1},
                            {"models", {{"ground", {{"file", "ground.gltf"}}}, {"lamp", {{"file", "lamp.gltf"}}}}},
                            {"environment", constantEnvironment(Point(0))},
                            {"camera", {{"position", {0, 0.9, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"fovy", 60}}}});
        const std::vector<ImageData> images = trace("lamp", 1, {{"spp", 4096}, {"bounces", 1}, {"technique", estimator}});
        return images.empty() ? 0 : meanOf(images[0]);
    };
    const double sheet = lit(false, "both");
    EXPECT_GT(sheet, 0.1);
    for (const char* estimator : {"both", "light", "bsdf"}) EXPECT_NEAR(lit(true, estimator) / sheet, 1, 0.01) << estimator;
}

// A card that turns over by a scale from 1 to -1 is gone in the frame in which it is 0, and nothing is harmed by motion to and from there.
TEST_F(FlatInstances, CardsTurnOver) {
    writeModel(folder, "card", cube);
    const std::vector<float> keys{0, 10.0f / 30, 2, 2, 1, -2, 2, 1};
    writeFile(folder / "keys.bin", std::as_bytes(std::span(keys)));
    OrderedJson gltf = OrderedJson::parse(readText(folder / "card.gltf"));
    const std::size_t views = gltf["bufferViews"].size();
    gltf["buffers"].push_back({{"uri", "keys.bin"}, {"byteLength", 32}});
    gltf["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", 0}, {"byteLength", 8}});
    gltf["bufferViews"].push_back({{"buffer", 1}, {"byteOffset", 8}, {"byteLength", 24}});
    gltf["accessors"].push_back(
        {{"bufferView", views}, {"componentType", 5126}, {"count", 2}, {"type", "SCALAR"}, {"min", {0}}, {"max", {keys[1]}}});
    gltf["accessors"].push_back({{"bufferView", views + 1}, {"componentType", 5126}, {"count", 2}, {"type", "VEC3"}});
    gltf["animations"] = OrderedJson::array(
        {OrderedJson{{"samplers", OrderedJson::array({OrderedJson{{"input", views}, {"output", views + 1}}})},
                     {"channels", OrderedJson::array({OrderedJson{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}})}}});
    // As a cube that turns inside out it is flat edge on; as a sheet without depth it is a line there.
    for (const bool sheet : {false, true}) {
        gltf["nodes"] = OrderedJson::array({OrderedJson{{"children", {1}}}, OrderedJson{{"mesh", 0}, {"scale", {1, 1, sheet ? 0 : 1}}}});
        writeFile(folder / "card.gltf", gltf.dump());
        writeScene(folder, "card", {{0.2, 0.3, 6}}, constantEnvironment(Point(0)));
        for (const char* rays : {"packet", "ray_query"}) {
            const std::vector<ImageData> images = trace("card", 10, exact, rays);
            ASSERT_EQ(images.size(), 10u);
            for (int frame = 0; frame < 10; ++frame) {
                SCOPED_TRACE(fmt::format("{}, frame {}, {}", sheet ? "sheet" : "cube", frame, rays));
                EXPECT_TRUE(allFinite(images[std::size_t(frame)]));
                if (frame != 5) {
                    EXPECT_EQ(images[std::size_t(frame)].at(8, 8, 0), 0.5f);
                }
            }
        }
        for (const char* graph : {"restir_pt.json", "restir_lod.json"}) {
            const std::vector<ImageData> images =
                render(sourceFolder / "graphs" / graph, "shade", 8, {.scene = folder / "card.json", .size = glm::uvec2(32, 18)});
            ASSERT_EQ(images.size(), 8u);
            for (const ImageData& image : images) EXPECT_TRUE(allFinite(image)) << graph;
            EXPECT_GT(meanOf(images[7]), 0.001) << graph;
        }
    }
}

}  // namespace
}  // namespace lodestir::test
