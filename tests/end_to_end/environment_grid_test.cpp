// SPDX-License-Identifier: MIT
// Maps of the environment that are many thousand texels wide: a sun of one texel, and texels that alternate between dark and bright. The answer is a
// sum over the map.
#include "frames.h"
#include "known_answer.h"
#include "model.h"
#include "planted_faults.h"

#include <framework/image/exr.h>

#include <functional>
#include <numbers>

namespace lodestir::test {
namespace {

constexpr int columns = 32768, rows = 8;  // wider than any real map, so that what rounds points shows at once; few rows keep it small

/// A floor without walls under a map; what it shows by one scattering.
class EnvironmentGrid : public testing::Test {
protected:
    void make(const std::function<float(int, int)>& radiance) {
        ImageData map = makeImage(columns, rows, 3);
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x)
                for (int c = 0; c < 3; ++c) map.at(x, y, c) = radiance(x, y);
        writeExr(folder.path / "map.exr", map);
        const Quad floor{{-20, 0, 20}, {40, 0, 0}, {0, 0, -40}, {.color = Point(albedo)}};
        writeModel(folder.path, "floor", {floor});
        writeScene(folder.path, "floor", {.position = {0, 1.5, 2}, .target = {0, 0, 0}, .fovy = 30}, {{"type", "map"}, {"file", "map.exr"}});
        // Bilinear between texel centres, columns repeat, rows end at the poles. Over a texel's width the mean of the three that it is made of is
        // exact, down its height midpoints will do.
        double irradiance = 0;
        constexpr int parts = 16;
        const auto at = [&](int x, int y) { return double(radiance((x + columns) % columns, std::clamp(y, 0, rows - 1))); };
        const auto across = [&](int x, int y) { return 0.125 * at(x - 1, y) + 0.75 * at(x, y) + 0.125 * at(x + 1, y); };
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x)
                for (int part = 0; part < parts; ++part) {
                    const double v = (part + 0.5) / parts, theta = std::numbers::pi * (y + v) / rows;
                    const int b = y + (v < 0.5 ? -1 : 0);
                    const double fv = v < 0.5 ? v + 0.5 : v - 0.5;
                    irradiance += ((1 - fv) * across(x, b) + fv * across(x, b + 1)) * std::max(std::cos(theta), 0.0) * std::sin(theta);
                }
        irradiance *= std::numbers::pi / (rows * parts) * 2 * std::numbers::pi / columns;
        expected_ = albedo / std::numbers::pi * irradiance;
    }
    EnsembleSetup setup(int runs) {
        return {.scene = folder.path / "floor.json",
                .size = {width, height},
                .warmup = 3,
                .frame = 3,
                .runs = runs,
                .reference = studyGraph(graphs / "path_tracer.json", "no accumulation", {{"trace.bounces", Json(1)}}),
                .referenceSamples = 4096,
                .device = sharedDevice()};
    }
    EnsembleResult judge(const char* name, const BlockMeans& runs) {
        ImageData image = makeImage(width, height, 3);
        std::ranges::fill(image.values, static_cast<float>(expected_));
        return judgeByAnswer(name, runs, known(image), 0.005);
    }
    void expectAllRight() {
        EnsembleJudge judged(setup(48));
        const EnsembleResult reference = judge("path tracing", judged.reference());
        EXPECT_EQ(reference.verdict, Verdict::unbiased) << reference.reason;
        const Setting one{"initial.bounces", Json(1)}, many{"initial.candidates", Json(16)};
        for (const char* variant : {"no reuse", "temporal only", "spatial only", ""}) {
            const EnsembleResult result = judge(variant, judged.measure(studyGraph(graphs / "restir_pt.json", *variant ? variant : nullptr, {one, many})));
            EXPECT_EQ(result.verdict, Verdict::unbiased) << variant << ": " << result.reason;
        }
        const EnsembleResult direct = judge("2022", judged.measure(studyGraph(graphs / "restir_pt_2022.json", nullptr, {})));
        EXPECT_EQ(direct.verdict, Verdict::unbiased) << direct.reason;
    }

    static constexpr int width = 32, height = 18;
    static constexpr double albedo = 0.5;
    const Path graphs = sourceFolder / "graphs";
    TemporaryFolder folder;

private:
    double expected_ = 0;
};

float sun(int x, int y) { return x == 5001 && y == 2 ? 8e4f : 0.5f; }

TEST_F(EnvironmentGrid, SunOfOneTexel) {
    make(sun);
    expectAllRight();
}

TEST_F(EnvironmentGrid, TexelsThatAlternate) {
    make([](int x, int y) { return (x + y) % 2 == 0 ? 1.0f : 1000.0f; });
    expectAllRight();
}

// Points of the map in 16 bits a coordinate are rounded across the borders of texels.
TEST_F(EnvironmentGrid, FindsPointsThatAreRounded) {
    make(sun);
    plant(folder.path, {{"rounded", "initial_sampling", "light/light.glsl",
                         "return LightPoint(light, sampleEnvironmentTexel(w, choice.y, u.x), u.yz);",
                         "{ EnvironmentPoint p = environmentPoint(w, unpackUnorm2x16(packUnorm2x16(environmentUv(w, EnvironmentPoint(sampleEnvironmentTexel(w, "
                         "choice.y, u.x), u.yz))))); return LightPoint(light, p.texel, p.place); }"}});
    ASSERT_FALSE(HasFailure());
    OrderedJson json = OrderedJson::parse(readText(graphs / "restir_pt.json"));
    json["scene"] = "floor.json";
    json["passes"]["initial"]["type"] = "rounded";
    writeFile(folder.path / "rounded.json", json.dump());
    EnsembleSetup setup = EnvironmentGrid::setup(48);
    setup.renderer.passes = {folder.path};
    EnsembleJudge judged(setup);
    const EnsembleResult result = judge(
        "rounded", judged.measure(studyGraph(folder.path / "rounded.json", "no reuse", {{"initial.bounces", Json(1)}, {"initial.candidates", Json(16)}})));
    EXPECT_EQ(result.verdict, Verdict::biased) << result.reason;
}

}  // namespace
}  // namespace lodestir::test
