// SPDX-License-Identifier: MIT
#include <framework/graph/runner.h>

#include <framework/core/files.h>
#include <framework/core/log.h>
#include <framework/core/tasks.h>
#include <framework/graph/header.h>
#include <framework/graph/kernels.h>
#include <framework/graph/port_memory.h>
#include <framework/graph/slices.h>
#include <framework/graph/texels.h>
#include <framework/graph/top_levels.h>
#include <framework/scene/scene.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <numeric>

namespace lodestir {

namespace {

constexpr std::array<std::string_view, 3> rayBodies{"packet", "lane", "ray_query"};

bool canTracePackets(const gpu::DeviceFacts& device) { return device.isLavapipe && device.subgroupSize == 8; }

}  // namespace

std::string_view nameOf(RayBody body) { return rayBodies[std::size_t(body)]; }

RayBody chooseRayBody(const gpu::DeviceFacts& device, const std::string& wish) {
    if (wish.empty()) return canTracePackets(device) ? RayBody::packet : device.rayQuery ? RayBody::rayQuery : RayBody::lane;
    const auto found = std::ranges::find(rayBodies, wish);
    if (found == rayBodies.end()) throw Error("no ray body \"" + wish + "\"", "known: packet, lane, ray_query");
    const auto body = RayBody(found - rayBodies.begin());
    if (body == RayBody::packet && !canTracePackets(device))
        throw Error("ray body \"packet\" needs lavapipe with subgroups of 8; this is " + device.name, "use --rays lane");
    if (body == RayBody::rayQuery && !device.rayQuery) throw Error("ray body \"ray_query\" needs VK_KHR_ray_query, which " + device.name + " lacks", "use --rays lane");
    return body;
}

std::string whyRayBody(const gpu::DeviceFacts& device) {
    switch (chooseRayBody(device, "")) {
        case RayBody::packet: return "packet: eight lanes of the CPU share one walk, several times faster here than the driver's ray query";
        case RayBody::rayQuery: return "ray_query: the device traces in hardware";
        case RayBody::lane: return "lane: the device has no ray query, so each lane walks our own hierarchy";
    }
    return {};
}

namespace {

constexpr std::uint32_t maxDispatches = 1024;  // of a frame that fetch tiles from a counter; each has a counter of its own
constexpr std::size_t counterStride = 64;      // bytes: one cache line each
constexpr std::uint32_t maxPieces = 128;       // of dispatches in one submission, where a frame is cut

}  // namespace

class Runner::State {
public:
    State(const gpu::Device& device, Graph& graph, const Scene& scene, RunnerOptions options)
        : device_(device),
          graph_(graph),
          scene_(scene),
          options_(std::move(options)),
          plan_(makePlan(graph, options_.pinned, {.allBarriers = options_.allBarriers})),
          kernels_(device, graph, options_),
          commands_(device, std::uint32_t(2 * plan_.steps.size() + 4) + (options_.slice > 0 ? 2 * maxPieces : 0)),
          slices_(options_.slice),
          size_(graph.description.size),
          counters_(device, maxDispatches * counterStride, gpu::Memory::device, "tile counters") {
        if (options_.rays == RayBody::rayQuery) topLevels_.emplace(device);
        allocate();
    }

    FrameReport run();
    void allocate();

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
    std::optional<TopLevels> topLevels_;  ///< with ray queries only
    gpu::Buffer counters_, ledger_, faults_, facts_;  ///< facts: ledger and faults, read back
    struct NodeState {
        BlockLayout layout;
        gpu::Buffer block;
        std::vector<std::byte> parameters;            ///< as of the last frame
        std::vector<std::string> texts;
        std::vector<std::uint64_t> inputVersions;     ///< that an onChange pass last ran with
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
        FrameReport report;
        std::vector<gpu::Buffer> staging;
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
    void fillBlock(std::size_t node);
    std::vector<std::uint64_t> inputVersions(std::size_t node) const;
    void checkFaults() const;
};

/// What a pass sees while it executes: records into the frame's command buffer.
class Runner::State::Recorder final : public Frame {
public:
    Recorder(State& state, int node, Work& work) : s_(state), node_(node), work_(work) {}

    std::uint32_t index() const override { return s_.frame_; }
    glm::uvec2 size() const override { return s_.size_; }
    bool historyValid() const override { return s_.historyValid_; }
    glm::uvec2 sizeOf(const Port& port) const override { return lodestir::sizeOf(s_.graph_, node_, numberOf(port), s_.size_); }
    std::uint32_t countOf(const Port& port) const override { return lodestir::countOf(s_.graph_, node_, numberOf(port), s_.size_); }
    bool isBound(const Port& port) const override {
        return !port.isInput() || s_.graph_.nodes[std::size_t(node_)].inputs[std::size_t(numberOf(port))].has_value();
    }
    const gpu::Device& device() const override { return s_.device_; }
    const Scene& scene() const override { return s_.scene_; }
    bool usesRayQuery() const override { return s_.topLevels_.has_value(); }

    void dispatch(std::string_view shader, glm::uvec2 extent, std::initializer_list<std::uint32_t> arguments) override {
        if (extent.x == 0 || extent.y == 0) return;
        if (arguments.size() > 4) throw Error("a dispatch of " + std::string(shader) + " has more than 4 arguments");
        separate();
        const Kernel& kernel = s_.kernels_.of(node_, shader);
        const Slices::Key key{node_, dispatched_++};
        const bool row = extent.y == 1;
        const std::uint32_t all = row ? extent.x : extent.y;
        for (std::uint32_t done = 0; done < all;) {
            const std::uint32_t rows = s_.slices_.take(key, all - done, row ? 64 : 8);
            if (rows > 0) piece(kernel, key, extent, done, rows, arguments);
            done += rows;
            if (rows == 0 || s_.slices_.full() || (s_.slices_.cuts() && work_.pieces.size() == maxPieces)) s_.handOver(work_);
        }
    }
    void fill(const Port& port, std::uint32_t word) override {
        separate();
        gpu::Buffer& buffer = made(port).now();
        s_.commands_.fill(buffer, 0, buffer.size(), word);
    }
    void upload(const Port& port, std::span<const std::byte> bytes) override {
        separate();
        PortMemory& memory = made(port);
        if (bytes.size() > memory.bytes) throw Error("upload of " + std::to_string(bytes.size()) + " bytes into port \"" + std::string(port.name) + "\" of " + std::to_string(memory.bytes));
        work_.staging.emplace_back(s_.device_, bytes.size(), gpu::Memory::upload, "staging");
        std::memcpy(work_.staging.back().mapped(), bytes.data(), bytes.size());
        s_.commands_.copy(work_.staging.back(), 0, memory.now(), 0, bytes.size());
    }
    std::span<const std::byte> valueOf(const Port& port) const override {
        const auto& source = s_.graph_.nodes[std::size_t(node_)].inputs[std::size_t(numberOf(port))];
        const int resource = source ? s_.plan_.resourceOf(source->node, source->port) : -1;
        if (resource < 0) throw Error("port \"" + std::string(port.name) + "\" is not wired");
        const PortMemory& memory = s_.memories_->at(std::size_t(resource));
        return {(source->prev ? memory.last() : memory.now()).mapped(), memory.bytes};
    }
    void provide(const Port& port, std::span<const std::byte> value, std::shared_ptr<const void> keep) override {
        PortMemory& memory = made(port);
        if (value.size() != memory.bytes) throw Error("port \"" + std::string(port.name) + "\" holds " + std::to_string(memory.bytes) + " bytes, given " + std::to_string(value.size()));
        // Compared with last frame's value, which is the other copy where there is one: an equal value is no change.
        const int before = memory.copies[0] == memory.copies[1] ? memory.current : memory.previous;
        const std::byte* old = memory.version > 0 ? memory.copies[std::size_t(before)]->mapped() : nullptr;
        std::vector<std::byte> bytes(value.begin(), value.end());
        keep = withInputs(std::move(keep));
        if (s_.topLevels_ && port.type.name == "World") keep = withTopLevel(bytes, old, memory.keep[std::size_t(before)], std::move(keep), memory.now().address());
        const bool same = old && std::memcmp(old, bytes.data(), bytes.size()) == 0;
        std::memcpy(memory.now().mapped(), bytes.data(), bytes.size());
        memory.keep[std::size_t(memory.current)] = std::move(keep);
        if (!same) ++memory.version;
    }

private:
    /// `rows` rows of a dispatch from row `first` on (pixels, where it is one row).
    void piece(const Kernel& kernel, Slices::Key key, glm::uvec2 extent, std::uint32_t first, std::uint32_t rows, std::initializer_list<std::uint32_t> arguments) {
        const bool row = extent.y == 1;
        Push push{};
        push.block = s_.nodes_[std::size_t(node_)].block.address();
        push.base = row ? glm::uvec2(first, 0) : glm::uvec2(0, first);
        push.extent = extent;
        push.rows = rows;
        std::copy(arguments.begin(), arguments.end(), &push.arguments.x);
        glm::uvec2 groups = groupCount(row ? glm::uvec2(rows, 1) : glm::uvec2(extent.x, rows));
        if (kernel.traces && s_.kernels_.persistent()) {
            if (work_.dispatches == maxDispatches) throw Error("more than " + std::to_string(maxDispatches) + " tracing dispatches in one frame");
            push.tileCounter = s_.counters_.address() + counterStride * work_.dispatches++;
            groups = {std::uint32_t(workerCount()), 1};
        }
        const std::uint32_t from = s_.slices_.cuts() ? s_.commands_.timestamp() : 0;
        s_.commands_.dispatch(kernel.pipeline, std::as_bytes(std::span(&push, 1)), groups.x, groups.y);
        if (s_.slices_.cuts()) work_.pieces.push_back({key, rows, from, s_.commands_.timestamp()});
    }
    int numberOf(const Port& port) const {
        const auto& ports = s_.graph_.nodes[std::size_t(node_)].pass->ports;
        return int(std::ranges::find(ports, &port) - ports.begin());
    }
    PortMemory& made(const Port& port) const {
        const int resource = s_.plan_.resourceOf(node_, numberOf(port));
        if (resource < 0) throw Error("port \"" + std::string(port.name) + "\" is not made by this pass");
        return s_.memories_->at(std::size_t(resource));
    }
    /// A struct may point to what the node's own inputs of this frame point to (a World with other levels): that lives as long. What came from last
    /// frame doesn't, or every frame would keep all before it.
    std::shared_ptr<const void> withInputs(std::shared_ptr<const void> own) const {
        auto kept = std::make_shared<std::vector<std::shared_ptr<const void>>>(1, std::move(own));
        for (const auto& source : s_.graph_.nodes[std::size_t(node_)].inputs) {
            const int resource = source && !source->prev ? s_.plan_.resourceOf(source->node, source->port) : -1;
            if (resource < 0) continue;
            const PortMemory& memory = s_.memories_->at(std::size_t(resource));
            if (const auto& keep = memory.keep[std::size_t(memory.current)]) kept->push_back(keep);
        }
        return kept;
    }
    /// Gives a World its top level: the old one where nothing else differs from the old World.
    std::shared_ptr<const void> withTopLevel(std::vector<std::byte>& bytes, const std::byte* old, const std::shared_ptr<const void>& oldKeep,
                                             std::shared_ptr<const void> keep, VkDeviceAddress place) const {
        World world;
        std::memcpy(&world, bytes.data(), sizeof world);
        if (world.instanceCount == 0) return keep;
        if (old) {
            std::memcpy(&world.tlas, old + offsetof(World, tlas), sizeof world.tlas);
            if (std::memcmp(old, &world, sizeof world) == 0) {
                std::memcpy(bytes.data(), &world, sizeof world);
                return oldKeep;
            }
        }
        auto kept = std::make_shared<std::vector<std::shared_ptr<const void>>>(1, std::move(keep));
        kept->push_back(s_.topLevels_->add(world, place));
        std::memcpy(bytes.data(), &world, sizeof world);
        return kept;
    }
    /// What one pass records is seen by what it records next.
    void separate() {
        if (recorded_) s_.commands_.barrier();
        recorded_ = true;
    }

    State& s_;
    int node_;
    Work& work_;
    int dispatched_ = 0;
    bool recorded_ = false;
};

void Runner::State::allocate() {
    memories_ = std::make_unique<PortMemories>(device_, graph_, plan_, size_);
    const std::size_t nodes = graph_.nodes.size();
    ledger_ = gpu::Buffer(device_, nodes * sizeof(RayCounts), gpu::Memory::device, "ray ledger");
    faults_ = gpu::Buffer(device_, nodes * sizeof(FaultRecord), gpu::Memory::device, "faults");
    facts_ = gpu::Buffer(device_, nodes * (sizeof(RayCounts) + sizeof(FaultRecord)), gpu::Memory::readback, "ledger and faults");
    nodes_.clear();
    for (const GraphNode& node : graph_.nodes) {
        NodeState state;
        state.layout = blockLayout(*node.pass);
        state.block = gpu::Buffer(device_, state.layout.bytes, gpu::Memory::upload, node.name + ": block");
        nodes_.push_back(std::move(state));
    }
    historyValid_ = false;
    fresh_ = true;
}

/// Takes over a node's parameters; true when one differs from last frame.
bool Runner::State::takeParameters(std::size_t node) {
    NodeState& state = nodes_[node];
    const Pass& pass = *graph_.nodes[node].pass;
    std::vector<std::byte> bytes(state.layout.bytes);
    writeParameters(pass, state.layout, bytes);
    std::vector<std::string> texts;
    for (const Parameter* p : pass.parameters)
        if (std::holds_alternative<std::string>(p->value)) texts.push_back(std::get<std::string>(p->value));
    const bool changed = bytes != state.parameters || texts != state.texts;
    state.parameters = std::move(bytes);
    state.texts = std::move(texts);
    return changed;
}

void Runner::State::fillBlock(std::size_t node) {
    NodeState& state = nodes_[node];
    std::vector<std::byte> block = state.parameters;
    const FrameInfo info{.index = frame_,
                         .seed = graph_.description.seed,
                         .size = size_,
                         .historyValid = historyValid_,
                         .validate = options_.checkBounds,
                         .salt = std::uint32_t(Hash().add(graph_.nodes[node].name).a >> 33),
                         .pad = 0,
                         .ledger = ledger_.address() + node * sizeof(RayCounts),
                         .faults = faults_.address() + node * sizeof(FaultRecord)};
    std::memcpy(block.data(), &info, sizeof info);
    const GraphNode& n = graph_.nodes[node];
    for (std::size_t p = 0; p < n.pass->ports.size(); ++p) {
        const Source source = n.pass->ports[p]->isInput() ? n.inputs[p].value_or(Source{}) : Source{int(node), int(p), false};
        PortRecord record{};
        if (source.node >= 0) {
            const int resource = plan_.resourceOf(source.node, source.port);
            if (resource >= 0) {
                const PortMemory& memory = memories_->at(std::size_t(resource));
                record.address = (source.prev ? memory.last() : memory.now()).address();
                const bool image = graph_.port(source).type.kind == PortType::Kind::image;
                record.size = image ? lodestir::sizeOf(graph_, source.node, source.port, size_) : glm::uvec2(countOf(graph_, source.node, source.port, size_), 1);
            }
        }
        std::memcpy(block.data() + state.layout.ports[p], &record, sizeof record);
    }
    std::memcpy(state.block.mapped(), block.data(), block.size());
}

std::vector<std::uint64_t> Runner::State::inputVersions(std::size_t node) const {
    std::vector<std::uint64_t> versions;
    for (const auto& input : graph_.nodes[node].inputs)
        if (input) versions.push_back(memories_->at(std::size_t(plan_.resourceOf(input->node, input->port))).version);
    return versions;
}

FrameReport Runner::State::run() {
    if (std::ranges::find(scene_.cuts, int(frame_)) != scene_.cuts.end()) historyValid_ = false;
    bool anyChange = false;
    std::vector<bool> changed(graph_.nodes.size());
    for (std::size_t i = 0; i < graph_.nodes.size(); ++i)
        if (!graph_.nodes[i].off) anyChange = (changed[i] = takeParameters(i)) || anyChange;

    Work work{.report = {.frame = frame_, .passes = {}}};
    beginSubmission(work);
    commands_.fill(ledger_, 0, ledger_.size(), 0);
    commands_.fill(faults_, 0, faults_.size(), 0);
    commands_.barrier();
    if (!historyValid_) memories_->clear(commands_, plan_, fresh_);
    fresh_ = false;

    bool handlesChanged = false;
    for (std::size_t i = 0; i < plan_.resources.size(); ++i) memories_->at(i).previous = memories_->at(i).current;
    for (const PlanStep& step : plan_.steps) {
        const auto node = std::size_t(step.node);
        const GraphNode& n = graph_.nodes[node];
        NodeState& state = nodes_[node];
        if (!step.barrier.empty()) commands_.barrier();
        const std::vector<std::uint64_t> versions = inputVersions(node);
        const bool runs = !step.onChange || !state.everRan || changed[node] || versions != state.inputVersions;
        state.inputVersions = versions;
        work.report.passes.push_back({.name = n.name, .ran = runs, .setup = step.onChange});
        if (!runs) continue;
        std::uint64_t handlesBefore = 0, handlesAfter = 0;  // sums of versions: they only grow
        for (std::size_t i = 0; i < plan_.resources.size(); ++i) {
            PortMemory& memory = memories_->at(i);
            if (plan_.resources[i].node != step.node) continue;
            if (memory.copies[0] != memory.copies[1]) memory.current = 1 - memory.current;
            if (memory.handle) handlesBefore += memory.version;
            else ++memory.version;
        }
        const bool restarts = n.pass->restartOnChange && (anyChange || handlesChanged) && historyValid_;
        beginStep(work);
        fillBlock(node);
        if (restarts) {
            for (std::size_t i = 0; i < plan_.resources.size(); ++i)
                if (plan_.resources[i].node == step.node && graph_.port({step.node, plan_.resources[i].port, false}).role == Port::Role::state)
                    commands_.fill(memories_->at(i).now(), 0, memories_->at(i).now().size(), 0);
            commands_.barrier();
        }
        Recorder recorder(*this, step.node, work);
        n.pass->execute(recorder);
        if (topLevels_) topLevels_->record(commands_);
        endStep(work);
        state.everRan = true;
        for (std::size_t i = 0; i < plan_.resources.size(); ++i)
            if (plan_.resources[i].node == step.node && memories_->at(i).handle) handlesAfter += memories_->at(i).version;
        handlesChanged |= handlesAfter != handlesBefore;
    }
    commands_.barrier();
    const std::size_t ledgerBytes = graph_.nodes.size() * sizeof(RayCounts);
    commands_.copy(ledger_, 0, facts_, 0, ledgerBytes);
    commands_.copy(faults_, 0, facts_, ledgerBytes, graph_.nodes.size() * sizeof(FaultRecord));
    commands_.barrier();
    endSubmission(work);

    for (std::size_t i = 0; i < plan_.steps.size(); ++i) {
        PassReport& pass = work.report.passes[i];
        if (!pass.ran) continue;
        if (!pass.setup) work.report.milliseconds += pass.milliseconds;
        std::memcpy(&pass.rays, facts_.mapped() + std::size_t(plan_.steps[i].node) * sizeof(RayCounts), sizeof(RayCounts));
    }
    if (options_.checkBounds) checkFaults();
    historyValid_ = true;
    ++frame_;
    return std::move(work.report);
}

void Runner::State::beginSubmission(Work& work) {
    commands_.begin();
    work.begin = commands_.timestamp();
    commands_.fill(counters_, 0, counters_.size(), 0);
    commands_.barrier();
    work.dispatches = 0;
    slices_.close();
}

/// Waits, and takes the times.
void Runner::State::endSubmission(Work& work) {
    const std::uint32_t end = commands_.timestamp();
    commands_.submit();
    commands_.wait();
    for (const Work::Step& step : work.steps) {
        PassReport& pass = work.report.passes[step.report];
        if (pass.milliseconds == 0) pass.start = work.report.wholeMilliseconds + commands_.milliseconds(work.begin, step.from);
        pass.milliseconds += commands_.milliseconds(step.from, step.to);
    }
    work.report.wholeMilliseconds += commands_.milliseconds(work.begin, end);
    for (const Work::Piece& piece : work.pieces) slices_.measured(piece.key, piece.rows, commands_.milliseconds(piece.from, piece.to));
    work.steps.clear();
    work.pieces.clear();
}

/// Lets the device have what was recorded of the current step, and goes on with the step in another submission.
void Runner::State::handOver(Work& work) {
    endStep(work);
    endSubmission(work);
    beginSubmission(work);
    beginStep(work);
}

void Runner::State::beginStep(Work& work) {
    commands_.beginLabel(work.report.passes.back().name);
    const std::uint32_t from = commands_.timestamp();
    work.steps.push_back({work.report.passes.size() - 1, from, from});
}

void Runner::State::endStep(Work& work) {
    work.steps.back().to = commands_.timestamp();
    commands_.endLabel();
}

void Runner::State::checkFaults() const {
    Problems problems;
    for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
        FaultRecord fault{};
        std::memcpy(&fault, facts_.mapped() + graph_.nodes.size() * sizeof(RayCounts) + i * sizeof fault, sizeof fault);
        if (fault.count == 0) continue;
        const GraphNode& n = graph_.nodes[i];
        problems.add(n.where, "pass \"" + n.name + "\": " + std::to_string(fault.count) + " accesses outside a port; the first: port \"" +
                                  std::string(n.pass->ports[fault.port]->name) + "\" at (" + std::to_string(fault.index.x) + ", " + std::to_string(fault.index.y) + ")");
    }
    problems.raise();
}

Runner::Runner(const gpu::Device& device, Graph& graph, const Scene& scene, RunnerOptions options)
    : state_(std::make_unique<State>(device, graph, scene, std::move(options))) {}
Runner::~Runner() = default;

FrameReport Runner::run() { return state_->run(); }
std::uint32_t Runner::nextFrame() const { return state_->frame_; }
void Runner::setFrame(std::uint32_t frame) { state_->frame_ = frame; }
void Runner::reset() { state_->historyValid_ = false; }
void Runner::resize(glm::uvec2 size) {
    state_->size_ = size;
    state_->allocate();
}

int Runner::reloadShaders(std::span<const Path> changed) { return state_->kernels_.reload(changed); }
std::vector<Path> Runner::shaderFiles() const { return state_->kernels_.files(); }

const gpu::Buffer& Runner::memoryOf(const Source& source) const {
    const int resource = state_->plan_.resourceOf(source.node, source.port);
    if (resource < 0) throw Error("port " + state_->graph_.nameOf(source) + " is not part of the plan");
    return state_->memories_->at(std::size_t(resource)).now();
}

std::vector<std::byte> Runner::readBytes(const Source& source) const {
    const gpu::Buffer& memory = memoryOf(source);
    std::vector<std::byte> bytes(state_->memories_->at(std::size_t(state_->plan_.resourceOf(source.node, source.port))).bytes);
    gpu::readBuffer(state_->device_, memory, 0, bytes);
    return bytes;
}

ImageData Runner::readImage(const Source& source) const {
    const glm::uvec2 extent = lodestir::sizeOf(state_->graph_, source.node, source.port, state_->size_);
    return decodeTexels(readBytes(source), state_->graph_.port(source).format, extent);
}

const Plan& Runner::plan() const { return state_->plan_; }
glm::uvec2 Runner::size() const { return state_->size_; }
std::size_t Runner::memoryBytes() const { return state_->memories_->bytes(); }
const std::vector<ShaderReport>& Runner::shaders() const { return state_->kernels_.reports(); }

}  // namespace lodestir
