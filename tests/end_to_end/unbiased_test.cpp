// SPDX-License-Identifier: MIT
// Reuse against path tracing on scenes that each stress one mechanism: short runs with fixed seeds, to one percent of the energy. The studies
// of the same names go to 0.3 %. By default each reuse is judged where nothing moves and through a lens, and where all does by
// moving_furnace_test and motion_blur_test; the suites Long add the other pairs.
#include "frames.h"
#include "model.h"
#include "program.h"

#include <framework/study/ensemble/ensemble.h>

namespace lodestir::test {
namespace {

struct Case {
    std::string scene;
    int candidates;  ///< path trees a pixel: as many as bring the half-width below 1 %
    int runs;
    const char* graph = "restir_pt.json";
    std::optional<std::string> variant = {};
    glm::uvec2 size{32, 18};  ///< larger where the mean of a small frame is noisy: neighbours share paths, and more pixels share fewer

    bool paired() const { return variant == std::string("paired") || graph == std::string("restir_pt_enhanced.json"); }
    const char* radius() const { return paired() ? "pairing.radius" : "spatial.radius"; }
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.scene; }

StudyGraph graph(const char* file, const char* variant, std::vector<Setting> set) {
    return {.graph = sourceFolder / "graphs" / file, .variant = variant, .set = std::move(set), .port = {}, .where = {}};
}

/// Judges a technique on a scene by `runs` fresh starts and path tracing.
void expectUnbiased(const std::string& scene, int runs, const StudyGraph& technique, const std::string& name, glm::uvec2 size = {32, 18}) {
    EnsembleJudge judge({.scene = sourceFolder / "scenes" / (scene + ".json"),
                         .size = size,
                         .warmup = 3,
                         .frame = 3,
                         .runs = runs,
                         .reference = graph("path_tracer.json", "no accumulation", {}),
                         .referenceSamples = 2048,
                         .device = sharedDevice()});
    const EnsembleResult reuse = judge.judge(technique);
    EXPECT_EQ(reuse.verdict, Verdict::unbiased) << reuse.reason;
    EXPECT_LE(reuse.halfWidth, 0.01);
    std::printf("%s: %+.2f %% +- %.2f %%\n", name.c_str(), 100 * (reuse.energy[0] / reuse.referenceEnergy[0] - 1), 100 * reuse.halfWidth);
}

class Unbiased : public testing::TestWithParam<Case> {};

TEST_P(Unbiased, ReuseHasTheMeanOfPathTracing) {
    const Case& c = GetParam();
    expectUnbiased(c.scene, c.runs,
                   {.graph = sourceFolder / "graphs" / c.graph,
                    .variant = c.variant,
                    .set = {{"initial.candidates", Json(c.candidates)}, {c.radius(), Json(5)}},
                    .port = {},
                    .where = {}},
                   c.scene, c.size);
}

// Light points behind panes that move: what is reused has no part in what a pane takes, which the pixel's own shadow ray finds.
TEST(UnbiasedLightPoints, HaveTheMeanOfOneScattering) {
    EnsembleJudge judge({.scene = sourceFolder / "scenes/ensemble_panes.json",
                         .size = {32, 18},
                         .warmup = 3,
                         .frame = 3,
                         .runs = 64,
                         .reference = graph("path_tracer.json", "no accumulation", {{"trace.bounces", Json(1)}, {"trace.film", Json("centre")}}),
                         .referenceSamples = 2048,
                         .device = sharedDevice()});
    const EnsembleResult reuse = judge.judge(
        {.graph = sourceFolder / "passes/restir/restir_di/restir_di.json", .variant = {}, .set = {{"direct.radius", Json(5)}}, .port = {}, .where = {}});
    EXPECT_EQ(reuse.verdict, Verdict::unbiased) << reuse.reason;
    EXPECT_LE(reuse.halfWidth, 0.01);
    std::printf("light points: %+.2f %% +- %.2f %%\n", 100 * (reuse.energy[0] / reuse.referenceEnergy[0] - 1), 100 * reuse.halfWidth);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Unbiased,
                         testing::Values(Case{"ensemble_diffuse", 2, 64}, Case{"ensemble_glossy", 4, 96}, Case{"ensemble_layers", 4, 96},
                                         Case{"ensemble_glass", 4, 192}, Case{"ensemble_lights", 4, 64}, Case{"ensemble_environment", 2, 64},
                                         Case{"ensemble_panes", 4, 96}, Case{"ensemble_lens", 8, 96},
                                         Case{"ensemble_orthographic", 2, 64, "restir_lod.json"}),
                         [](const auto& test) { return test.param.scene + (test.param.graph == std::string("restir_lod.json") ? "_splatted" : ""); });

std::string sceneName(const testing::TestParamInfo<Case>& test) { return test.param.scene; }

INSTANTIATE_TEST_SUITE_P(LongScenes, Unbiased,
                         testing::Values(Case{"ensemble_moving", 8, 128, "restir_pt.json", {}, {64, 36}}, Case{"ensemble_orthographic", 2, 64}), sceneName);

std::string pairedName(const testing::TestParamInfo<Case>& test) { return test.param.scene + (test.param.variant ? "_alone" : "_with_all"); }

// Partners that share their shifts, alone and with everything else of ReSTIR PT Enhanced: footprints, lights of tiles, one place inside all pixels.
INSTANTIATE_TEST_SUITE_P(Paired, Unbiased,
                         testing::Values(Case{"ensemble_lights", 4, 192, "restir_pt_enhanced.json"}), pairedName);
INSTANTIATE_TEST_SUITE_P(LongPaired, Unbiased,
                         testing::Values(Case{"ensemble_glass", 4, 512, "restir_pt.json", "paired"},
                                         Case{"ensemble_glossy", 4, 96, "restir_pt.json", "paired"},
                                         Case{"ensemble_lens", 8, 80, "restir_pt_enhanced.json", {}, {64, 36}},
                                         Case{"ensemble_glossy", 4, 256, "restir_pt_enhanced.json"}),
                         pairedName);

// One place inside the pixel for a frame: the mean over runs, whose frames have other places, is the same box filter's. With a lens it is judged
// above, splatted below.
INSTANTIATE_TEST_SUITE_P(FrameJitter, Unbiased, testing::Values(Case{"ensemble_diffuse", 2, 192, "restir_pt.json", "frame jitter"}), sceneName);
INSTANTIATE_TEST_SUITE_P(LongFrameJitter, Unbiased,
                         testing::Values(Case{"ensemble_glass", 4, 384, "restir_pt.json", "frame jitter"},
                                         Case{"ensemble_moving", 8, 960, "restir_pt.json", "frame jitter"}),
                         sceneName);

// Rows of studies/restir_pt_enhanced/combinations.json, which judges all eight: techniques that share code where neither knows of the other.
struct Combination {
    const char* row;
    const char* scene;
    const char* radius;  ///< the parameter
    int runs;
};

void PrintTo(const Combination& c, std::ostream* out) { *out << c.row; }

class UnbiasedTogether : public testing::TestWithParam<Combination> {};

TEST_P(UnbiasedTogether, ReuseHasTheMeanOfPathTracing) {
    const Combination& c = GetParam();
    const Study study = loadStudy(sourceFolder / "studies/restir_pt_enhanced/combinations.json");
    const auto row = std::ranges::find(study.techniques, c.row, &Technique::name);
    ASSERT_NE(row, study.techniques.end());
    StudyGraph judged = row->graph;
    judged.set.push_back({c.radius, Json(5)});
    expectUnbiased(c.scene, c.runs, judged, c.row);
}

std::string combinationName(const testing::TestParamInfo<Combination>& test) { return test.param.scene; }

INSTANTIATE_TEST_SUITE_P(LongCombinations, UnbiasedTogether,
                         testing::Values(Combination{"tiles, vector weights, two rounds, splatting", "ensemble_lights", "spatial.radius", 96},
                                         Combination{"all", "ensemble_moving", "pairing.radius", 512}),
                         combinationName);

// Unlit surfaces light what is around them, are found by the BSDF alone, and are reconnected to: an emitter that no light sample finds.
TEST(UnbiasedUnlit, ReuseHasTheMeanOfPathTracing) {
    const TemporaryFolder temporary;
    const Path& folder = temporary.path;
    std::vector<Quad> quads = box({0, 0, 0}, {4, 3, 4}, {.color = {0.7, 0.6, 0.5}}, /* inward = */ true);
    quads.push_back({{0.2, 2.9, 0.2}, {3.6, 0, 0}, {0, 0, 3.6}, {.color = {0.9, 0.8, 0.7}, .layers = {{"KHR_materials_unlit", OrderedJson::object()}}}});
    for (Quad& quad : box({0.8, 0, 1}, {1.9, 1.2, 2.2}, {.color = {0.6, 0.6, 0.3}, .roughness = 0.3})) quads.push_back(quad);
    writeModel(folder, "unlit", quads);
    writeScene(folder, "unlit", {.position = {3.3, 1.9, 3.8}, .target = {1.4, 1.0, 1.2}, .fovy = 65}, constantEnvironment(Point(0)));
    EnsembleJudge judge({.scene = folder / "unlit.json",
                         .size = {32, 18},
                         .warmup = 3,
                         .frame = 3,
                         .runs = 64,
                         .reference = graph("path_tracer.json", "no accumulation", {}),
                         .referenceSamples = 2048,
                         .device = sharedDevice()});
    for (const char* technique : {"both", "light"}) {
        const EnsembleResult reuse = judge.judge({.graph = sourceFolder / "graphs/restir_pt.json",
                                                  .variant = {},
                                                  .set = {{"initial.candidates", Json(4)}, {"initial.technique", Json(technique)}, {"spatial.radius", Json(5)}},
                                                  .port = {},
                                                  .where = {}});
        EXPECT_EQ(reuse.verdict, Verdict::unbiased) << technique << ": " << reuse.reason;
        EXPECT_LE(reuse.halfWidth, 0.01);
    }
}

}  // namespace
}  // namespace lodestir::test
