// SPDX-License-Identifier: MIT
#include <framework/study/content.h>
#include <framework/study/ensemble/runs.h>
#include <framework/study/frame_cost.h>

#include <algorithm>
#include <set>

namespace lodestir {
namespace {

constexpr std::array<double, 3> luminance{0.2126, 0.7152, 0.0722};

std::string keyOf(const EnsembleChunk& chunk) {
    return configurationKey(chunk.scene, chunk.technique.value_or(std::size_t(-1)), chunk.knobs);
}

/// Whether a node's outputs depend on earlier frames; `seen`: nodes that were asked already.
bool hasHistory(const Graph& graph, int node, std::set<int>& seen) {
    if (!seen.insert(node).second) return false;
    const GraphNode& n = graph.nodes[std::size_t(node)];
    return std::ranges::any_of(n.pass->ports, [](const Port* port) { return port->role == Port::Role::state; }) ||
           std::ranges::any_of(n.inputs, [&](const auto& input) { return input && (input->prev || hasHistory(graph, input->node, seen)); });
}
bool hasHistory(const StagedGraph& staged) {
    std::set<int> seen;
    return hasHistory(staged.graph, staged.port.node, seen);
}

/// Sums over runs.
class FrameSum {
public:
    void add(const ImageData& image, const FrameReport& report) {
        frame_.means.add(image);
        if (sum_.empty()) sum_.resize(4 * image.pixelCount());
        for (std::size_t p = 0; p < image.pixelCount(); ++p) {
            double y = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                sum_[4 * p + c] += double(image.values[3 * p + c]);
                y += luminance[c] * double(image.values[3 * p + c]);
            }
            sum_[4 * p + 3] += y * y;
        }
        frame_.milliseconds += report.milliseconds;
        frame_.rays += raysOf(report);
    }
    ChunkFrame finish() {
        const auto runs = double(frame_.means.runs());
        frame_.image = makeImage(frame_.means.grid.width, frame_.means.grid.height, 4);
        std::ranges::transform(sum_, frame_.image.values.begin(), [&](double value) { return float(value / runs); });
        frame_.milliseconds /= runs;
        frame_.rays /= runs;
        return std::move(frame_);
    }

private:
    ChunkFrame frame_;
    std::vector<double> sum_;
};

}  // namespace

bool EnsembleChunk::isSeriesOf(const EnsembleChunk& other) const { return keyOf(*this) == keyOf(other); }

int batchesOf(const Study& study) {
    const auto pixels = std::uint64_t(study.scenes.front().pixels());
    const auto most = int(std::clamp<std::uint64_t>(samplesPerFrame / pixels, 1, 1024));
    int batches = referenceBatches;
    while (study.referenceSamples / batches > most && study.referenceSamples % (2 * batches) == 0) batches *= 2;
    return batches;
}

std::vector<EnsembleChunk> expandChunks(const Study& study) {
    std::vector<EnsembleChunk> chunks;
    const auto add = [&](EnsembleChunk chunk, int runs) {
        for (chunk.first = 0; chunk.first < runs; chunk.first += chunkRuns) {
            chunk.count = std::min(chunkRuns, runs - chunk.first);
            chunks.push_back(chunk);
        }
    };
    for (std::size_t scene = 0; scene < study.scenes.size(); ++scene) {
        add({.scene = scene}, batchesOf(study));
        for (std::size_t technique = 0; technique < study.techniques.size(); ++technique)
            for (auto& knobs : combinations(study.techniques[technique]))
                add({.scene = scene, .technique = technique, .knobs = std::move(knobs)}, int(study.seeds.size()));
    }
    return chunks;
}

StagedGraph EnsembleStage::build(const EnsembleChunk& chunk) {
    if (!chunk.technique) return stage_.buildReference(chunk.scene, study_.referenceSamples / batchesOf(study_));
    return stage_.build(study_.techniques[*chunk.technique].graph, chunk.knobs, chunk.scene,
                        drawnSeed(study_, *chunk.technique, chunk.knobs, study_.seeds.front()));
}

std::string EnsembleStage::nameOf(const EnsembleChunk& chunk) {
    const std::string key = keyOf(chunk);
    if (!contents_.contains(key)) {
        const StagedGraph staged = build(chunk);
        Hash content;
        content.addValue(stage_.sceneContent(chunk.scene)).addValue(contentOf(staged.graph)).add(staged.graph.nameOf(staged.port));
        for (const int value : {chunk.technique ? study_.warmup : 0, study_.event}) content.addValue(value);
        for (const int offset : study_.measure) content.addValue(offset);
        contents_[key] = content;
    }
    return Hash(contents_[key]).addValue(chunk.first).addValue(chunk.count).hex();
}

EnsembleStage::Series& EnsembleStage::seriesOf(const EnsembleChunk& chunk) {
    if (series_ && series_->chunk.isSeriesOf(chunk)) return *series_;
    series_.reset();  // before its scene goes
    series_ = std::make_unique<Series>(Series{.chunk = chunk, .staged = build(chunk), .runner = nullptr});
    series_->runner = stage_.makeRunner(series_->staged, chunk.scene);
    return *series_;
}

std::vector<ChunkFrame> EnsembleStage::render(const EnsembleChunk& chunk) {
    Series& series = seriesOf(chunk);
    auto& staged = series.staged;
    auto& runner = series.runner;
    const bool freshStarts = !chunk.technique || !hasHistory(staged);  // each frame alone, without warm-up
    std::vector<FrameSum> sums(study_.measure.size());
    const auto run = [&](std::uint32_t seed, int from, int to) {
        staged.graph.description.seed = seed;
        runner->reset();
        runner->setFrame(std::uint32_t(study_.event + from));
        for (int offset = from; offset <= to; ++offset) {
            const FrameReport report = runner->run();
            const auto measured = std::ranges::find(study_.measure, offset);
            if (measured != study_.measure.end())
                sums[std::size_t(measured - study_.measure.begin())].add(stage_.imageOf(*runner, staged), report);
        }
    };
    for (int i = chunk.first; i < chunk.first + chunk.count; ++i) {
        const std::uint32_t seed = chunk.technique ? drawnSeed(study_, *chunk.technique, chunk.knobs, study_.seeds[std::size_t(i)])
                                                   : firstReferenceSeed + std::uint32_t(i);
        if (!freshStarts) run(seed, -study_.warmup, study_.measure.back());
        if (freshStarts)
            for (const int offset : study_.measure) run(seed, offset, offset);
    }
    std::vector<ChunkFrame> frames;
    for (FrameSum& sum : sums) frames.push_back(sum.finish());
    return frames;
}

}  // namespace lodestir
