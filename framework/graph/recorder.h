// SPDX-License-Identifier: MIT
// What a pass sees while it executes; included by runner.cpp alone.
#pragma once
#include <framework/core/tasks.h>
#include <framework/graph/runner_state.h>
#include <framework/graph/texels.h>
#include <framework/pass/scene.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace lodestir {

/// What a pass sees while it executes: records into the frame's command buffer.
class Runner::State::Recorder final : public Frame {
public:
    /// `asBefore`: parameters and inputs of this frame are those that it ran with last.
    Recorder(State& state, int node, Work& work, bool asBefore) : s_(state), node_(node), work_(work), asBefore_(asBefore) {}

    std::uint32_t index() const override { return s_.frame_; }
    std::uint32_t seed() const override { return s_.graph_.description.seed; }
    glm::uvec2 size() const override { return s_.size_; }
    bool historyValid() const override { return s_.historyValid_; }
    glm::uvec2 sizeOf(const Port& port) const override { return lodestir::sizeOf(s_.graph_, node_, numberOf(port), s_.size_); }
    std::uint32_t countOf(const Port& port) const override { return s_.countOf(std::size_t(node_), std::size_t(numberOf(port))); }
    bool isBound(const Port& port) const override {
        return !port.isInput() || s_.graph_.nodes[std::size_t(node_)].inputs[std::size_t(numberOf(port))].has_value();
    }
    const Scene& scene() const override { return s_.scene_; }
    SceneRecords sceneRecords() const override { return s_.world().records(); }

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
        if (s_.probe_ && s_.probe_->asks()) {
            s_.handOver(work_);
            s_.probe_->told(node_, shader, arguments, kernel.probes);
        }
    }
    void fill(const Port& port, std::uint32_t word) override {
        separate();
        gpu::Buffer& buffer = made(port).now();
        s_.commands_.fill(buffer, 0, buffer.size(), word);
    }
    void reserve(const Port& port, std::uint32_t elements) override {
        if (port.count.kind != Count::Kind::reserved) throw Error("port \"" + std::string(port.name) + "\" has a size of its own");
        if (recorded_) throw Error("port \"" + std::string(port.name) + "\" is reserved after something was recorded");
        auto before = s_.memories_->reserve(s_.device_, std::size_t(s_.plan_.resourceOf(node_, numberOf(port))), elements * port.type.size,
                                            s_.graph_.nameOf({node_, numberOf(port), false}));
        if (!before) return;
        work_.staging.push_back(std::move(*before));
        s_.fillBlock(std::size_t(node_));
    }
    using Frame::reserve;
    void upload(const Port& port, std::span<const std::byte> bytes) override {
        separate();
        PortMemory& memory = made(port);
        if (bytes.size() > memory.bytes)
            throw Error("upload of " + std::to_string(bytes.size()) + " bytes into port \"" + std::string(port.name) + "\" of " + std::to_string(memory.bytes));
        work_.staging.emplace_back(s_.device_, bytes.size(), gpu::Memory::upload, "staging");
        std::memcpy(work_.staging.back().mapped(), bytes.data(), bytes.size());
        s_.commands_.copy(work_.staging.back(), 0, memory.now(), 0, bytes.size());
    }
    using Frame::upload;
    Memory upload(std::span<const std::byte> bytes, const std::string& name) override {
        return handedOut(std::make_shared<const gpu::Buffer>(gpu::makeBuffer(s_.device_, bytes, name)));
    }
    Memory allocate(std::size_t bytes, const std::string& name) override { return handedOut(newBuffer(bytes, name)); }
    KeptMemory kept(const Hash& key, std::size_t bytes, const std::string& name) override {
        const Path path = s_.keptFile(std::size_t(node_), key, bytes);
        if (const auto content = readSealed(path); content && content->size() == bytes) return {upload(*content, name), true};
        const auto buffer = newBuffer(bytes, name);
        work_.kept.push_back({path, buffer, bytes});
        return {handedOut(buffer), false};
    }
    std::span<const std::byte> bytesOf(const Port& port) const override {
        const auto& source = s_.graph_.nodes[std::size_t(node_)].inputs[std::size_t(numberOf(port))];
        const int resource = source ? s_.plan_.resourceOf(source->node, source->port) : -1;
        if (resource < 0) throw Error("port \"" + std::string(port.name) + "\" is not wired");
        const PortMemory& memory = s_.memories_->at(std::size_t(resource));
        return {(source->prev ? memory.last() : memory.now()).mapped(), memory.bytes};
    }
    void provide(const Port& port, std::span<const std::byte> value, std::shared_ptr<const void> keep,
                 std::optional<std::span<const std::byte>> meaning) override {
        PortMemory& memory = made(port);
        if (value.size() != memory.bytes)
            throw Error("port \"" + std::string(port.name) + "\" holds " + std::to_string(memory.bytes) + " bytes, given " + std::to_string(value.size()));
        // Compared with last frame's value, which is the other copy where there is one: an equal value is no change.
        const int before = memory.copies[0] == memory.copies[1] ? memory.current : memory.previous;
        const std::byte* old = memory.version > 0 ? memory.copies[std::size_t(before)]->mapped() : nullptr;
        std::vector<std::byte> bytes(value.begin(), value.end());
        keep = withInputs(std::move(keep));
        if (s_.topLevels_ && port.type.isSame(PortTypeOf<World>::value))
            keep = withTopLevel(bytes, old, memory.keep[std::size_t(before)], std::move(keep), memory.now().address());
        bool same = old != nullptr;
        if (meaning) {
            same = same && asBefore_ && std::ranges::equal(*meaning, memory.meaning);
            memory.meaning.assign(meaning->begin(), meaning->end());
        } else {
            same = same && std::memcmp(old, bytes.data(), bytes.size()) == 0;
        }
        std::memcpy(memory.now().mapped(), bytes.data(), bytes.size());
        memory.keep[std::size_t(memory.current)] = std::move(keep);
        if (!same) ++memory.version;
    }
    void provideScene(const Port& world, float at, float shutter) override {
        FrameWorld made = s_.world().at(at, s_.size_, shutter);
        const World meaning = made.value;
        if (shutter > 0) made.value.frameKey = frameKey(*this);
        provide(world, std::as_bytes(std::span(&made.value, 1)), made.keep, std::as_bytes(std::span(&meaning, 1)));
    }
    Memory objects(const In<World>& posed) override {
        std::optional<World> pose;
        if (isBound(posed)) pose = valueOf(posed);
        FrameWorld made = s_.world().objects(pose ? &*pose : nullptr);
        const auto buffer = std::make_shared<const gpu::Buffer>(s_.device_, sizeof(World), gpu::Memory::upload, "objects");
        auto keep = std::make_shared<std::vector<std::shared_ptr<const void>>>();
        if (s_.topLevels_ && made.value.instanceCount > 0) keep->push_back(s_.topLevels_->add(made.value, buffer->address()));
        std::memcpy(buffer->mapped(), &made.value, sizeof(World));
        if (s_.topLevels_) s_.topLevels_->record(s_.commands_);
        keep->insert(keep->end(), {buffer, std::move(made.keep)});
        return {buffer->address(), keep};
    }

private:
    /// `rows` rows of a dispatch from row `first` on (pixels, where it is one row).
    void piece(const Kernel& kernel, Slices::Key key, glm::uvec2 extent, std::uint32_t first, std::uint32_t rows,
               std::initializer_list<std::uint32_t> arguments) {
        const bool row = extent.y == 1;
        Push push{};
        push.block = s_.nodes_[std::size_t(node_)].block.address();
        push.base = row ? glm::uvec2(first, 0) : glm::uvec2(0, first);
        push.extent = extent;
        push.rows = rows;
        std::copy(arguments.begin(), arguments.end(), &push.arguments.x);
        glm::uvec2 groups = groupCount(row ? glm::uvec2(rows, 1) : glm::uvec2(extent.x, rows));
        if (kernel.traces && usesPersistentGroups(s_.device_)) {
            if (work_.dispatches == maxDispatches) throw Error("more than " + std::to_string(maxDispatches) + " tracing dispatches in one frame");
            push.tileCounter = s_.counters_.address() + counterStride * work_.dispatches++;
            groups = {std::uint32_t(workerCount()), 1};
        }
        const std::uint32_t from = s_.slices_.cuts() ? s_.commands_.timestamp() : 0;
        s_.commands_.dispatch(*kernel.pipeline, std::as_bytes(std::span(&push, 1)), groups.x, groups.y);
        if (s_.slices_.cuts()) work_.pieces.push_back({key, rows, from, s_.commands_.timestamp()});
    }
    std::shared_ptr<const gpu::Buffer> newBuffer(std::size_t bytes, const std::string& name) const {
        return std::make_shared<const gpu::Buffer>(s_.device_, bytes, gpu::Memory::device, name);
    }
    Memory handedOut(const std::shared_ptr<const gpu::Buffer>& buffer) {
        work_.handedOut.push_back(buffer);
        return {buffer->address(), buffer};
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
    bool asBefore_;
    int dispatched_ = 0;
    bool recorded_ = false;
};

}  // namespace lodestir
