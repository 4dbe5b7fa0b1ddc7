// SPDX-License-Identifier: MIT
// What an ensemble renders: many short runs of one configuration that differ in their seed only, chunk by chunk, in one runner.
#pragma once
#include <framework/study/ensemble/block_means.h>
#include <framework/study/stage.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lodestir {

/// Runs in a row that are measured and written down together.
struct EnsembleChunk {
    std::size_t scene = 0;
    std::optional<std::size_t> technique;  ///< none: the reference, whose runs are batches of samples
    std::vector<Setting> knobs;
    int first = 0, count = 0;

    bool isSeriesOf(const EnsembleChunk& other) const;  ///< the same but for its runs
};

/// Runs of a chunk; the last one of a configuration may have fewer.
inline constexpr int chunkRuns = 32;

/// Scene by scene, in each the reference and then the techniques, whose chunks stand together because a new graph costs more than a run.
std::vector<EnsembleChunk> expandChunks(const Study& study);

/// Batches that the reference of a study is rendered in, a multiple of referenceBatches that divides its samples evenly.
int batchesOf(const Study& study);

/// A measured frame over the runs of a chunk.
struct ChunkFrame {
    BlockMeans means;
    ImageData image;                    ///< over runs: the means of red, green and blue, and of the squared luminance
    double milliseconds = 0, rays = 0;  ///< of the frame, means over runs
};

class EnsembleStage {
public:
    EnsembleStage(Stage& stage, const Study& study) : stage_(stage), study_(study) {}

    /// Hash of all that a chunk's frames depend on but the device.
    std::string nameOf(const EnsembleChunk& chunk);
    /// The measured frames, parallel to Study::measure.
    std::vector<ChunkFrame> render(const EnsembleChunk& chunk);

private:
    struct Series {
        EnsembleChunk chunk;  ///< one of those it is for
        StagedGraph staged;
        std::unique_ptr<Runner> runner;
    };
    StagedGraph build(const EnsembleChunk& chunk);
    Series& seriesOf(const EnsembleChunk& chunk);

    Stage& stage_;
    const Study& study_;
    std::unique_ptr<Series> series_;
    std::map<std::string, Hash> contents_;  ///< of graphs, by configuration
};

}  // namespace lodestir
