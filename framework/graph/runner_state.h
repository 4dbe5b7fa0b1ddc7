// SPDX-License-Identifier: MIT
// What a runner keeps from frame to frame, and the frame that it is making.
#pragma once
#include <framework/graph/header.h>
#include <framework/graph/kernels.h>
#include <framework/graph/port_memory.h>
#include <framework/graph/probe_memory.h>
#include <framework/graph/runner.h>
#include <framework/graph/slices.h>
#include <framework/graph/top_levels.h>
#include <framework/scene/upload/world.h>

#include <memory>
#include <optional>

namespace lodestir {

inline constexpr std::uint32_t maxDispatches = 1024;  // of a frame that fetch tiles from a counter; each has a counter of its own
inline constexpr std::size_t counterStride = 64;      // bytes: one cache line each
inline constexpr std::uint32_t maxPieces = 128;       // of dispatches in one submission, where a frame is cut

class Runner::State {
public:
    State(const gpu::Device& device, Graph& graph, const Scene& scene, RunnerOptions options)
        : device_(device),
          graph_(graph),
          scene_(scene),
          options_(std::move(options)),
          plan_(makePlan(graph, options_.pinned, {.keepAll = options_.keepAll, .sharing = options_.shareMemory, .allBarriers = options_.allBarriers})),
          kernels_(device, graph, plan_, scene, options_),
          commands_(device, std::uint32_t(2 * plan_.steps.size() + 4) + (options_.slice > 0 ? 2 * maxPieces : 0)),
          slices_(options_.slice),
          size_(graph.description.size),
          counters_(device, maxDispatches * counterStride, gpu::Memory::device, "tile counters") {
        if (options_.probe) probe_.emplace(device);
        if (options_.rays == RayBody::rayQuery) topLevels_.emplace(device);
        allocate();
    }

    FrameReport run();
    void allocate();
    WorldBuilder& world();  ///< the scene on the device, laid out when first asked for

    const gpu::Device& device_;
    Graph& graph_;
    const Scene& scene_;
    RunnerOptions options_;
    Plan plan_;
    Kernels kernels_;
    gpu::Commands commands_;
    Slices slices_;
    glm::uvec2 size_;
    std::uint32_t frame_ = 0;
    bool historyValid_ = false, fresh_ = true;  ///< fresh: memory never cleared
    std::unique_ptr<PortMemories> memories_;
    std::optional<WorldBuilder> world_;
    std::optional<TopLevels> topLevels_;  ///< with ray queries only
    std::optional<ProbeMemory> probe_;
    gpu::Buffer counters_, ledger_, faults_, facts_;  ///< facts: ledger and faults, read back
    struct NodeState {
        BlockLayout layout;
        gpu::Buffer block;
        std::vector<std::byte> parameters;            ///< as of the last frame
        std::vector<std::string> texts;
        std::vector<std::uint64_t> inputVersions;     ///< that an onChange pass last ran with
        std::vector<std::uint64_t> inputVersionsNow;  ///< the same without @prev
        bool everRan = false;
    };
    std::vector<NodeState> nodes_;  ///< parallel to Graph::nodes

private:
    class Recorder;
    /// A frame in the making. It may go to the device in several submissions; the stamps are those of the one that is being recorded.
    struct Work {
        struct Step {
            std::size_t report;
            std::uint32_t from, to;
        };
        struct Piece {
            Slices::Key key;
            std::uint32_t rows, from, to;
        };
        struct Kept {
            Path file;
            std::shared_ptr<const gpu::Buffer> memory;
            std::size_t bytes;
        };
        FrameReport report;
        std::vector<gpu::Buffer> staging;
        std::vector<std::shared_ptr<const gpu::Buffer>> handedOut;
        std::vector<Kept> kept;  ///< to be written to the cache when the frame is done
        std::uint32_t dispatches = 0;
        std::vector<Step> steps;
        std::vector<Piece> pieces;
        std::uint32_t begin = 0;  ///< stamp
    };
    void beginSubmission(Work& work);
    void endSubmission(Work& work);
    void handOver(Work& work);
    void beginStep(Work& work);
    void endStep(Work& work);
    bool takeParameters(std::size_t node);
    std::uint32_t countOf(std::size_t node, std::size_t port) const;  ///< elements of a buffer port as they are now
    void fillBlock(std::size_t node);
    std::vector<std::uint64_t> inputVersions(std::size_t node, bool withPrevious) const;
    void checkFaults() const;
    Path keptFile(std::size_t node, const Hash& key, std::size_t bytes) const;  ///< of Frame::kept()
    void keep(const Work& work) const;
};

}  // namespace lodestir
