// SPDX-License-Identifier: MIT
// Ensembles without files: tests ask whether a graph has the mean that path tracing has, in a few seconds.
#pragma once
#include <framework/study/ensemble/runs.h>
#include <framework/study/ensemble/verdict.h>

namespace lodestir {

struct EnsembleSetup {
    Path scene;
    glm::uvec2 size{64, 64};  ///< pixels
    int warmup = 0;           ///< frames before the measured one, of which history is made
    int frame = 0;            ///< of the scene that is measured, at least `warmup`
    int runs = 64;
    std::uint32_t seed = 1;  ///< of the first run; the next ones count on
    StudyGraph reference;
    int referenceSamples = 4096;  ///< a pixel, a multiple of referenceBatches
    double halfWidth = 0.01;      ///< see VerdictOptions
    RendererOptions renderer;
    std::shared_ptr<const gpu::Device> device;  ///< that several judges share, with what it has compiled; none: one of its own
};

/// Judges graphs on one scene: device, scene and reference are made once.
class EnsembleJudge {
public:
    /// Renders the reference. Error when something is wrong with the scene or its graph.
    explicit EnsembleJudge(EnsembleSetup setup);
    ~EnsembleJudge();

    /// Renders the runs of a graph and judges them.
    EnsembleResult judge(const StudyGraph& graph);

    /// The measured runs themselves, for what is to be asked beyond the verdict.
    BlockMeans measure(const StudyGraph& graph);
    const BlockMeans& reference() const { return reference_; }

private:
    BlockMeans render(std::optional<std::size_t> technique, int runs);

    Study study_;
    Stage stage_;
    BlockMeans reference_;
};

}  // namespace lodestir
