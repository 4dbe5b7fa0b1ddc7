// SPDX-License-Identifier: MIT
#include <framework/graph/runner.h>

#include <framework/core/files.h>
#include <framework/core/log.h>
#include <framework/graph/recorder.h>

#include <algorithm>
#include <cstring>

namespace lodestir {

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
        state.block = gpu::Buffer(device_, state.layout.bytes + (probe_ ? sizeof(VkDeviceAddress) : 0), gpu::Memory::upload, node.name + ": block");
        nodes_.push_back(std::move(state));
    }
    historyValid_ = false;
    fresh_ = true;
}

WorldBuilder& Runner::State::world() {
    if (!world_) world_.emplace(device_, scene_, topLevels_.has_value());
    return *world_;
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

std::uint32_t Runner::State::countOf(std::size_t node, std::size_t port) const {
    const Port& made = *graph_.nodes[node].pass->ports[port];
    if (made.isInput() || made.count.kind != Count::Kind::reserved) return lodestir::countOf(graph_, int(node), int(port), size_);
    return std::uint32_t(memories_->at(std::size_t(plan_.resourceOf(int(node), int(port)))).bytes / made.type.size);
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
                record.size = image ? lodestir::sizeOf(graph_, source.node, source.port, size_)
                                    : glm::uvec2(countOf(std::size_t(source.node), std::size_t(source.port)), 1);
            }
        }
        std::memcpy(block.data() + state.layout.ports[p], &record, sizeof record);
    }
    std::memcpy(state.block.mapped(), block.data(), block.size());
    if (probe_) {
        const VkDeviceAddress address = probe_->address();
        std::memcpy(state.block.mapped() + block.size(), &address, sizeof address);
    }
}

std::vector<std::uint64_t> Runner::State::inputVersions(std::size_t node, bool withPrevious) const {
    std::vector<std::uint64_t> versions;
    for (const auto& input : graph_.nodes[node].inputs)
        if (input && (withPrevious || !input->prev)) versions.push_back(memories_->at(std::size_t(plan_.resourceOf(input->node, input->port))).version);
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
        const std::vector<std::uint64_t> versions = inputVersions(node, true), versionsNow = inputVersions(node, false);
        const bool runs = !step.onChange || !state.everRan || changed[node] || versions != state.inputVersions;
        const bool asBefore = state.everRan && !changed[node] && versionsNow == state.inputVersionsNow;
        state.inputVersions = versions;
        state.inputVersionsNow = versionsNow;
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
        Recorder recorder(*this, step.node, work, asBefore);
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
    keep(work);
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
                                  std::string(n.pass->ports[fault.port]->name) + "\" at (" + std::to_string(fault.index.x) + ", " +
                                  std::to_string(fault.index.y) + ")");
    }
    problems.raise();
}

Path Runner::State::keptFile(std::size_t node, const Hash& key, std::size_t bytes) const {
    const Plugin& plugin = *graph_.nodes[node].plugin;
    Hash hash = contentOf(shadersOf(plugin), includeFolders(plugin));
    hash.addValue(key).addValue(bytes).add(device_.facts().name).add(device_.facts().driverVersion).add(nameOf(options_.rays));
    return cacheFolder(graph_.nodes[node].type) / (hash.hex() + ".bin");
}

void Runner::State::keep(const Work& work) const {
    for (const Work::Kept& kept : work.kept) {
        std::vector<std::byte> bytes(kept.bytes);
        gpu::readBuffer(device_, *kept.memory, 0, bytes);
        try {
            writeSealed(kept.file, bytes);
        } catch (const Error& error) {
            log::warn("the cache can't be written: {}", error.what());  // slower next time, no worse
        }
    }
}

Runner::Runner(const gpu::Device& device, Graph& graph, const Scene& scene, RunnerOptions options)
    : state_(std::make_unique<State>(device, graph, scene, std::move(options))) {}
Runner::~Runner() = default;

void Runner::prepare(const std::function<void(std::size_t, std::size_t)>& progress) {
    std::vector<int> nodes;
    for (const PlanStep& step : state_->plan_.steps) nodes.push_back(step.node);
    state_->kernels_.prepare(nodes, progress);
}

FrameReport Runner::run() { return state_->run(); }
std::vector<ProbedDispatch> Runner::probe(glm::ivec2 pixel) {
    state_->probe_->ask(pixel);
    state_->run();
    return state_->probe_->take();
}
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
