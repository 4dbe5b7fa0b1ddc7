// SPDX-License-Identifier: MIT
// Light sampling, BSDF sampling and both together are estimates of one image; so are images with and without roulette.
//
// Frames of a run are independent. Each test compares 16 frames of each estimator by Welch's t: the energy, and 48 block means
// (16x16 pixels x 3 channels) with Bonferroni, both at 1e-3, so a correct renderer fails 1 run of 500 at most (and seeds are fixed: it
// fails always or never). Power is asserted: the 95 % half-width of the energy's ratio is at most 1 %, so that a bias of 3 % is found
// nearly always; a planted one is.
#include "model.h"
#include "program.h"
#include "render.h"
#include "statistics.h"

namespace lodestir::test {
namespace {

constexpr int frameCount = 16;

class Estimators : public ProgramTest {
protected:
    std::vector<ImageData> frames(const std::string& name, const OrderedJson& parameters, std::uint32_t seed) {
        return render(writeGraph(folder, name, 64, 64, parameters), "trace", frameCount, {.seed = seed});
    }

    void expectEqual(const std::vector<ImageData>& a, const std::vector<ImageData>& b, const std::string& what) {
        if (HasFailure()) return;
        const Comparison comparison = compareFrames(a, b), faulty = compareFrames(a, b, 16, 1.03);
        std::printf("%s: %s\n", what.c_str(), comparison.text.c_str());
        EXPECT_TRUE(comparison.equal()) << what << ": " << comparison.text;
        EXPECT_LE(comparison.halfWidth, 0.01) << what << ": inconclusive";
        EXPECT_FALSE(faulty.equal()) << what << ": a planted bias of 3 % goes unseen: " << faulty.text;
    }
};

/// A closed room with coloured walls, a block, and a third of the ceiling alight.
std::vector<Quad> room(bool lamp) {
    std::vector<Quad> quads = box({0, 0, 0}, {4, 3, 4}, {.color = {0.7, 0.7, 0.7}}, /* inward = */ true);
    quads[0].paint.color = {0.7, 0.15, 0.1};
    quads[1].paint.color = {0.12, 0.55, 0.15};
    for (Quad& quad : box({0.8, 0, 1}, {1.9, 1.2, 2.2}, {.color = {0.6, 0.6, 0.3}})) quads.push_back(quad);
    if (lamp) quads.push_back({{1.2, 2.9, 1.2}, {1.8, 0, 0}, {0, 0, 1.8}, {.color = Point(0), .emission = {3, 2.5, 2}}});  // faces down
    return quads;
}
const View inside{.position = {3.3, 1.9, 3.8}, .target = {1.4, 1.0, 1.2}, .fovy = 65};

TEST_F(Estimators, AreaLight) {
    writeModel(folder, "room", room(true));
    writeScene(folder, "room", inside, constantEnvironment(Point(0)));
    const auto both = frames("room", {{"spp", 16}, {"bounces", 5}}, 1);
    const auto light = frames("room", {{"spp", 16}, {"bounces", 5}, {"technique", "light"}}, 2);
    const auto bsdf = frames("room", {{"spp", 64}, {"bounces", 5}, {"technique", "bsdf"}}, 3);
    expectEqual(light, both, "light sampling against both");
    expectEqual(bsdf, both, "BSDF sampling against both");
    expectEqual(frames("room", {{"spp", 16}, {"bounces", 5}, {"roulette", false}}, 4), both, "without roulette against with");
    expectEqual(frames("room", {{"spp", 24}, {"bounces", 5}, {"rouletteStart", 1}}, 5), both, "early roulette against late");
}

/// Blocks of different gloss on a floor under an uneven map: a warm bright patch above, a blue rim.
TEST_F(Estimators, Environment) {
    ImageData map = makeImage(32, 16, 3);
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 32; ++x) {
            const bool patch = x >= 4 && x < 9 && y >= 2 && y < 6;
            map.at(x, y, 0) = patch ? 6.0f : 0.2f;
            map.at(x, y, 1) = patch ? 4.5f : 0.3f;
            map.at(x, y, 2) = patch ? 2.0f : y == 7 ? 1.5f : 0.5f;
        }
    }
    writeExr(folder / "map.exr", map);
    std::vector<Quad> quads{{{-3, 0, -3}, {0, 0, 6}, {6, 0, 0}, {.color = {0.6, 0.5, 0.4}}}};
    for (Quad& quad : box({-1.6, 0, -0.8}, {-0.6, 1.4, 0.3}, {.color = {0.8, 0.8, 0.8}, .roughness = 0.5, .ior = 1.5}))
        quads.push_back(quad);
    for (Quad& quad : box({0.3, 0, -0.6}, {1.3, 0.8, 0.5}, {.color = {0.9, 0.6, 0.3}, .metallic = 1, .roughness = 0.6}))
        quads.push_back(quad);
    writeModel(folder, "blocks", quads);
    writeScene(folder, "blocks", {.position = {1.5, 2.6, 4.5}, .target = {-0.1, 0.4, 0}, .fovy = 40},
               {{"type", "map"}, {"file", "map.exr"}, {"rotationDegrees", 40}, {"strength", 1.0}});
    const auto both = frames("blocks", {{"spp", 16}, {"bounces", 3}}, 1);
    expectEqual(frames("blocks", {{"spp", 32}, {"bounces", 3}, {"technique", "light"}}, 2), both, "light sampling against both");
    expectEqual(frames("blocks", {{"spp", 32}, {"bounces", 3}, {"technique", "bsdf"}}, 3), both, "BSDF sampling against both");
}

// Nothing can hit a point; the choice among several lights must not depend on the estimator.
TEST_F(Estimators, PointLight) {
    writeModel(folder, "room", room(true));
    writeScene(
        folder, "room", inside, constantEnvironment(Point(0)),
        OrderedJson::array({OrderedJson{{"type", "point"}, {"position", {2.0, 2.0, 3.0}}, {"intensity", 2.0}, {"color", {1, 0.9, 0.7}}},
                            OrderedJson{{"type", "spot"},
                                        {"position", {3.5, 2.5, 0.5}},
                                        {"direction", {-1, -1.5, 1}},
                                        {"intensity", 4.0},
                                        {"innerConeDegrees", 10},
                                        {"outerConeDegrees", 30}}}));
    const auto both = frames("room", {{"spp", 24}, {"bounces", 3}}, 1);
    expectEqual(frames("room", {{"spp", 24}, {"bounces", 3}, {"technique", "light"}}, 2), both, "light sampling against both");
    // Lights without extent are sampled all the same; only the lamp is left to chance.
    expectEqual(frames("room", {{"spp", 48}, {"bounces", 3}, {"technique", "bsdf"}}, 3), both, "BSDF sampling against both");
}

// An unlit ceiling sends out what a lamp of that radiance would, but no light sample looks for it: all estimators have its light from the BSDF.
TEST_F(Estimators, UnlitSurfaceIsALampThatNobodySamples) {
    std::vector<Quad> lamp = room(false), unlit = lamp;
    constexpr std::size_t ceiling = 3;  // nothing is behind it: an unlit surface is seen through from there, a lamp is not
    lamp[ceiling].paint = {.color = Point(0), .emission = {0.9, 0.8, 0.7}};
    unlit[ceiling].paint = {.color = lamp[ceiling].paint.emission, .layers = {{"KHR_materials_unlit", OrderedJson::object()}}};
    for (const auto& [name, quads] : {std::pair("lamp", lamp), std::pair("unlit", unlit)}) {
        writeModel(folder, name, quads);
        writeScene(folder, name, inside, constantEnvironment(Point(0)));
    }
    const auto expected = frames("lamp", {{"spp", 16}, {"bounces", 4}}, 1);
    for (const auto& [estimator, seed] : {std::pair("both", 2u), std::pair("light", 3u), std::pair("bsdf", 4u)})
        expectEqual(frames("unlit", {{"spp", 32}, {"bounces", 4}, {"technique", estimator}}, seed), expected,
                    std::string("unlit, ") + estimator);
    const Output scene = lodestir({"scene", (folder / "unlit.json").string(), "--json"});
    EXPECT_EQ(OrderedJson::parse(scene.out)["triangles"]["emissive"], 0) << "none is a light";
}

}  // namespace
}  // namespace lodestir::test
