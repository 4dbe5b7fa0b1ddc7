// SPDX-License-Identifier: MIT
#include <framework/graph/port_memory.h>

#include <algorithm>
#include <utility>

namespace lodestir {

PortMemories::PortMemories(const gpu::Device& device, const Graph& graph, const Plan& plan, glm::uvec2 frame) {
    const auto make = [&](std::size_t size, gpu::Memory memory, const std::string& name) {
        buffers_.push_back(std::make_unique<gpu::Buffer>(device, size, memory, name));
        bytes_ += buffers_.back()->size();
        return buffers_.back().get();
    };
    std::vector<std::size_t> groupBytes(std::size_t(plan.groups), 0);
    for (const PlanResource& r : plan.resources)
        if (r.group >= 0) groupBytes[std::size_t(r.group)] = std::max(groupBytes[std::size_t(r.group)], bytesOf(graph, r.node, r.port, frame));
    std::vector<gpu::Buffer*> groups;
    for (std::size_t size : groupBytes) groups.push_back(make(size, gpu::Memory::device, "shared ports"));

    for (const PlanResource& r : plan.resources) {
        PortMemory memory;
        memory.bytes = bytesOf(graph, r.node, r.port, frame);
        const Source source{r.node, r.port, false};
        memory.handle = graph.port(source).type.kind == PortType::Kind::handle;
        // The CPU writes handles between frames' work: @prev and the frame in the making need one each.
        const auto kind = memory.handle ? gpu::Memory::upload : gpu::Memory::device;
        const std::string name = graph.nameOf(source);
        memory.copies[0] = r.group >= 0 ? groups[std::size_t(r.group)] : make(memory.bytes, kind, name);
        memory.copies[1] = r.copies == 2 ? make(memory.bytes, kind, name + " (previous)") : memory.copies[0];
        memories_.push_back(std::move(memory));
    }
}

std::unique_ptr<gpu::Buffer> PortMemories::reserve(const gpu::Device& device, std::size_t resource, std::size_t bytes, const std::string& name) {
    PortMemory& memory = memories_[resource];
    if (memory.bytes == bytes) return {};
    const auto buffer = std::ranges::find(buffers_, memory.copies[0], [](const auto& owned) { return owned.get(); });
    auto before = std::exchange(*buffer, std::make_unique<gpu::Buffer>(device, bytes, gpu::Memory::device, name));
    bytes_ += (*buffer)->size() - before->size();
    memory.copies = {buffer->get(), buffer->get()};
    memory.bytes = bytes;
    return before;
}

void PortMemories::clear(gpu::Commands& commands, const Plan& plan, bool all) {
    for (std::size_t i = 0; i < memories_.size(); ++i) {
        PortMemory& memory = memories_[i];
        const bool state = plan.resources[i].keeps;
        if (memory.handle || (!all && !state)) continue;  // a handle's struct must stay valid: shaders ask historyValid
        for (gpu::Buffer* buffer : memory.copies) commands.fill(*buffer, 0, buffer->size(), 0);
        ++memory.version;
    }
    commands.barrier();
}

}  // namespace lodestir
