// SPDX-License-Identifier: MIT
// Reuse against path tracing on scenes that each stress one mechanism: short runs with fixed seeds, to one percent of the energy. The studies
// of the same names go to 0.3 %.
#include "program.h"

#include <framework/study/ensemble.h>

namespace lodestir::test {
namespace {

struct Case {
    std::string scene;
    int candidates;  ///< path trees a pixel: as many as bring the half-width below 1 %
    int runs;
    const char* graph = "restir_pt.json";
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.scene; }

StudyGraph graph(const char* file, const char* variant, std::vector<StudySetting> set) {
    return {.graph = sourceFolder / "graphs" / file, .variant = variant, .set = std::move(set), .port = {}, .where = {}};
}

class Unbiased : public testing::TestWithParam<Case> {};

TEST_P(Unbiased, ReuseHasTheMeanOfPathTracing) {
    const Case& c = GetParam();
    EnsembleJudge judge({.scene = sourceFolder / "scenes" / (c.scene + ".json"),
                         .size = {32, 18},
                         .warmup = 3,
                         .frame = 3,
                         .runs = c.runs,
                         .reference = graph("path_tracer.json", "no accumulation", {}),
                         .referenceSamples = 2048});
    const EnsembleResult reuse =
        judge.judge({.graph = sourceFolder / "graphs" / c.graph, .variant = {}, .set = {{"initial.candidates", Json(c.candidates)}, {"spatial.radius", Json(5)}}, .port = {}, .where = {}});
    EXPECT_EQ(reuse.verdict, Verdict::unbiased) << reuse.reason;
    EXPECT_LE(reuse.halfWidth, 0.01);
    std::printf("%s: %+.2f %% +- %.2f %%\n", c.scene.c_str(), 100 * (reuse.energy[0] / reuse.referenceEnergy[0] - 1), 100 * reuse.halfWidth);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Unbiased,
                         testing::Values(Case{"ensemble_diffuse", 2, 64}, Case{"ensemble_glossy", 4, 96}, Case{"ensemble_layers", 4, 96}, Case{"ensemble_glass", 4, 96},
                                         Case{"ensemble_lights", 4, 64}, Case{"ensemble_environment", 2, 64}, Case{"ensemble_moving", 8, 960},
                                         Case{"ensemble_lens", 8, 96}, Case{"ensemble_orthographic", 2, 64},
                                         Case{"ensemble_orthographic", 2, 64, "restir_lod.json"}),
                         [](const auto& test) { return test.param.scene + (test.param.graph == std::string("restir_lod.json") ? "_splatted" : ""); });

}  // namespace
}  // namespace lodestir::test
