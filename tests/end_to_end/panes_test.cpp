// SPDX-License-Identifier: MIT
// Lights without extent shine through what lets light go straight on, and every technique says so alike. If these fail, leaves and panes with
// soft edges throw solid shadows in the sun, and rooms behind windows are dark.
#include "model.h"
#include "shift_session.h"

#include <framework/image/png.h>

#include <cmath>
#include <numbers>

namespace lodestir::test {
namespace {

/// All that casts shadow rays: the path tracer, light points reused in space and time, paths likewise; through pixels' centres, where no two
/// panes meet.
const std::vector<std::string> techniques{"trace.color", "direct.color", "shade.color"};

OrderedJson passes(int bounces, int spp) {
    return {{"trace", {{"type", "path_tracer"}, {"set", {{"bounces", bounces}, {"spp", spp}, {"film", "centre"}}}}},
            {"hits", hitsNode()},
            {"direct", node("restir_di", {{"hits", "hits"}, {"hitsPrev", "hits@prev"}, {"motion", "hits.motion"}, {"history", "direct@prev"}})},
            {"initial", node("initial_sampling", {{"hits", "hits"}}, {{"bounces", bounces}, {"camera", "hits"}})},
            {"temporal", node("temporal_reprojection", pathsOf("initial", "spatial"))},
            {"spatial", node("spatial_reuse", pathsOf("temporal"), {{"radius", 5}})},
            {"shade", shadeNode("spatial")}};
}

/// The camera is below the panes and sees one square unit of a white floor from above, +x to the right.
const View view{.position = {0, 1, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .fovy = 2 * std::atan(0.5) * 180 / std::numbers::pi};
constexpr int size = 32;

/// A square parallel to the floor, fronts up.
Quad sheet(double height, double halfWidth, const Paint& paint) {
    return {{-halfWidth, height, -halfWidth}, {0, 0, 2 * halfWidth}, {2 * halfWidth, 0, 0}, paint};
}
Quad turnedOver(Quad quad) {
    std::swap(quad.a, quad.b);
    return quad;
}
Paint veil(double alpha, const Point& color = Point(0)) { return {.color = color, .alpha = alpha}; }
Paint glass(const Point& tint) { return {.color = tint, .roughness = 0, .ior = 1.5, .transmission = 1}; }

const OrderedJson sun = {{"type", "directional"}, {"direction", {0, -1, 0}}, {"intensity", 1}};
const OrderedJson lamp = {{"type", "point"}, {"position", {0.3, 2.6, -0.2}}, {"intensity", 7}};
const OrderedJson torch = {{"type", "spot"}, {"position", {-0.4, 2.8, 0.1}}, {"direction", {0.1, -1, 0}},
                           {"intensity", 7}, {"outerConeDegrees", 25},       {"innerConeDegrees", 5}};

const double lit = 1 / std::numbers::pi;  ///< a white floor under one lux

class Panes : public testing::Test {
protected:
    /// The third frame of every technique, the light's first bounce.
    std::vector<ImageData> render(const std::vector<Quad>& panes, const OrderedJson& light) {
        std::vector<Quad> quads{sheet(0, 2, {.color = Point(1)})};
        quads.insert(quads.end(), panes.begin(), panes.end());
        writeModel(folder.path, "room", quads);
        return renderModel(light);
    }
    std::vector<ImageData> renderModel(const OrderedJson& light) {
        writeScene(folder.path, "room", view, constantEnvironment(Point(0)), OrderedJson::array({light}));
        Frames frames(folder.path / "room.json", glm::uvec2(size), passes(1, 1), techniques);
        frames.run(3);
        notes = frames.scene().notes;
        std::vector<ImageData> images;
        for (const std::string& technique : techniques) images.push_back(frames.image(technique));
        return images;
    }

    TemporaryFolder folder;
    std::vector<std::string> notes;
};

/// Panes above one strip of the floor, under the sun, and the share of its light that arrives there.
struct Strip {
    std::string what;
    std::vector<Paint> panes;
    Point share;
    bool fromBehind = false;  ///< the sun shines on their backs
};

// What a pane scatters itself is another path's. KHR_materials_transmission: what is not reflected passes, tinted once, where the wall is thin
// and clear. One looks into unlit rooms from behind their walls, and so does the sun.
TEST_F(Panes, LeaveTheirShareOfTheSun) {
    const Point tint{0.9, 0.6, 0.3};
    Paint glossy = veil(0.5, {0.9, 0.2, 0.1}), halfGlass = glass(tint), frosted = glass(tint), solid = glass(tint),
          unlit{.color = Point(0)};
    glossy.roughness = 0.2;
    glossy.ior = 1.5;
    halfGlass.alpha = 0.5;
    frosted.roughness = 0.4;
    solid.solid = true;
    unlit.layers = {{"KHR_materials_unlit", OrderedJson::object()}};
    const std::vector<Strip> strips{{"nothing", {}, Point(1)},
                                    {"alpha 0", {veil(0)}, Point(1)},
                                    {"alpha 0.25", {veil(0.25)}, Point(0.75)},
                                    {"alpha 0.5", {veil(0.5)}, Point(0.5)},
                                    {"alpha 0.5 from behind", {veil(0.5)}, Point(0.5), true},
                                    {"alpha 1", {veil(1)}, Point(0)},
                                    {"two", {veil(0.25), veil(0.5)}, Point(0.375)},
                                    {"eight", std::vector<Paint>(8, veil(0.25)), Point(std::pow(0.75, 8))},
                                    {"colour and gloss", {glossy}, Point(0.5)},
                                    {"before a wall", {veil(0.5), {.color = Point(0)}}, Point(0)},
                                    {"thin glass", {glass(tint)}, 0.96 * tint},
                                    {"thin glass that blends", {halfGlass}, 0.5 + 0.5 * 0.96 * tint},
                                    {"frosted", {frosted}, Point(0)},
                                    {"solid", {solid}, Point(0)},
                                    {"unlit, its back to the floor", {unlit}, Point(1)},
                                    {"unlit, its front to the floor", {unlit}, Point(0), true}};
    constexpr int wide = 2;  // pixels
    ASSERT_EQ(strips.size() * wide, std::size_t(size));
    std::vector<Quad> quads;
    for (std::size_t i = 0; i < strips.size(); ++i) {
        const double width = 1.0 / double(strips.size());
        for (std::size_t p = 0; p < strips[i].panes.size(); ++p) {
            const Quad quad{{-0.5 + width * double(i), 2 + 0.1 * double(p), -1}, {0, 0, 2}, {width, 0, 0}, strips[i].panes[p]};
            quads.push_back(strips[i].fromBehind ? turnedOver(quad) : quad);
        }
    }
    const std::vector<ImageData> images = render(quads, sun);
    for (std::size_t t = 0; t < techniques.size(); ++t) {
        for (int x = 0; x < size; ++x) {
            const Strip& strip = strips[std::size_t(x / wide)];
            double worst = 0;
            for (int y = 0; y < size; ++y)
                for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(images[t].at(x, y, c) - strip.share[c] * lit));
            EXPECT_LE(worst, 1e-5) << techniques[t] << ", " << strip.what;
        }
    }
    EXPECT_EQ(std::ranges::count_if(
                  notes, [](const std::string& note) { return note.find("do not shine through clear solids") != std::string::npos; }),
              1);
}

TEST_F(Panes, OnlyThoseBeforeTheLightCount) {
    for (const OrderedJson& light : {lamp, torch}) {
        const std::vector<ImageData> clear = render({}, light), dimmed = render({sheet(2, 4, veil(0.5)), sheet(3, 4, veil(0.5))}, light);
        for (std::size_t t = 0; t < techniques.size(); ++t) {
            double worst = 0;
            for (std::size_t i = 0; i < clear[t].values.size(); ++i)
                if (i % 4 != 3) worst = std::max(worst, std::abs(dimmed[t].values[i] - 0.5 * clear[t].values[i]));
            EXPECT_LE(worst, 1e-5) << techniques[t];
            EXPECT_GT(sumOf(firstChannels(clear[t], 3)) / (3 * size * size), 0.1) << techniques[t];
        }
    }
}

TEST_F(Panes, AlphaIsThatOfThePoint) {
    writeModel(folder.path, "room", {sheet(0, 2, {.color = Point(1)}), sheet(2, 0.5, veil(1))});
    const double alphas[] = {0, 0.2, 0.6, 1};
    ImageData stripes = makeImage(4, 1, 4);
    for (int i = 0; i < 4; ++i) stripes.at(i, 0, 3) = float(alphas[i]);
    writePng(folder.path / "stripes.png", stripes);
    // The texture's u grows with x, as the quad's second edge does.
    const std::array<glm::vec2, 6> uv{{{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}}};
    OrderedJson gltf = OrderedJson::parse(readText(folder.path / "room.gltf"));
    writeFile(folder.path / "uv.bin", std::as_bytes(std::span(uv)));
    gltf["buffers"].push_back({{"uri", "uv.bin"}, {"byteLength", sizeof(uv)}});
    gltf["bufferViews"].push_back({{"buffer", 1}, {"byteLength", sizeof(uv)}});
    gltf["accessors"].push_back({{"bufferView", 2}, {"componentType", 5126}, {"count", 6}, {"type", "VEC2"}});
    gltf["meshes"][0]["primitives"][1]["attributes"]["TEXCOORD_0"] = 2;
    gltf["images"] = OrderedJson::array({OrderedJson{{"uri", "stripes.png"}}});
    gltf["samplers"] = OrderedJson::array({OrderedJson{{"magFilter", 9728}, {"minFilter", 9728}}});
    gltf["textures"] = OrderedJson::array({OrderedJson{{"source", 0}, {"sampler", 0}}});
    gltf["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    writeFile(folder.path / "room.gltf", gltf.dump());
    const std::vector<ImageData> images = renderModel(sun);
    for (std::size_t t = 0; t < images.size(); ++t) {
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                EXPECT_NEAR(images[t].at(x, y, 0), (1 - alphas[x / (size / 4)]) * lit, 1e-5)
                    << techniques[t] << ", pixel " << x << ", " << y;
        EXPECT_NEAR(sumOf(firstChannels(images[t], 3)) / (3 * size * size), (1 + 0.8 + 0.4) / 4 * lit, 1e-5) << techniques[t];
    }
}

// Light that paths find behind panes is not counted along shadow rays as well: sun and sky under a pane that covers half.
TEST_F(Panes, TheSkyIsCountedOnce) {
    writeModel(folder.path, "room", {sheet(0, 2, {.color = Point(1)}), sheet(2, 400, veil(0.5))});
    writeScene(folder.path, "room", view, constantEnvironment(Point(1)), OrderedJson::array({sun}));
    Frames frames(folder.path / "room.json", glm::uvec2(size), passes(2, 64), techniques);
    double traced = 0, reused = 0;
    constexpr int runs = 24;
    for (int i = 0; i < runs; ++i) {
        frames.run();
        traced += sumOf(firstChannels(frames.image("trace.color"), 3)) / (3 * size * size) / runs;
        reused += sumOf(firstChannels(frames.image("shade.color"), 3)) / (3 * size * size) / runs;
    }
    const double expected = 0.5 * (1 + lit);
    EXPECT_NEAR(traced, expected, 0.002);
    EXPECT_NEAR(reused, expected, 0.01);
}

}  // namespace
}  // namespace lodestir::test
