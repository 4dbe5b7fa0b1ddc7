// SPDX-License-Identifier: MIT
#include <framework/core/error.h>
#include <framework/study/ensemble/ensemble.h>

namespace lodestir {
namespace {

Study studyOf(const EnsembleSetup& setup) {
    if (setup.frame < setup.warmup) throw Error("an ensemble measures a frame after its warm-up, not before");
    if (setup.referenceSamples % referenceBatches != 0) throw Error("an ensemble's reference needs a multiple of 64 samples a pixel");
    Study study{.kind = StudyKind::ensemble,
                .scenes = {{setup.scene.stem().string(), setup.scene, {}, setup.size}},
                .sizes = {setup.size},
                .paired = true,  // graphs have no names to be told apart by
                .warmup = setup.warmup,
                .event = setup.frame,
                .measure = {0},
                .reference = setup.reference,
                .referenceSamples = setup.referenceSamples,
                .halfWidth = setup.halfWidth};
    for (int run = 0; run < setup.runs; ++run) study.seeds.push_back(setup.seed + std::uint32_t(run));
    return study;
}

}  // namespace

EnsembleJudge::EnsembleJudge(EnsembleSetup setup) : study_(studyOf(setup)), stage_(study_, setup.renderer, setup.device) {
    reference_ = render(std::nullopt, batchesOf(study_));
}

EnsembleJudge::~EnsembleJudge() = default;

BlockMeans EnsembleJudge::render(std::optional<std::size_t> technique, int runs) {
    EnsembleStage stage(stage_, study_);
    return stage.render({.technique = technique, .count = runs}).front().means;
}

BlockMeans EnsembleJudge::measure(const StudyGraph& graph) {
    study_.techniques = {Technique{.name = graph.graph.stem().string(), .graph = graph}};
    return render(0, int(study_.seeds.size()));
}

EnsembleResult EnsembleJudge::judge(const StudyGraph& graph) {
    return judgeEnsemble(measure(graph), reference_, {.halfWidth = study_.halfWidth});
}

}  // namespace lodestir
