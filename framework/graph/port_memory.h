// SPDX-License-Identifier: MIT
// The GPU memory behind the ports of a plan: one or two copies each, with the version of what they hold.
#pragma once
#include <framework/gpu/commands.h>
#include <framework/graph/plan.h>

#include <array>
#include <memory>
#include <vector>

namespace lodestir {

/// Memory of one resource. Where there is one copy, both are the same buffer.
struct PortMemory {
    std::array<gpu::Buffer*, 2> copies{};
    std::array<std::shared_ptr<const void>, 2> keep;  ///< handles: owns what the struct points to
    int current = 0;
    int previous = 0;           ///< the copy that @prev reads: what was current when the frame began
    std::uint64_t version = 0;  ///< counts changes of the content
    std::vector<std::byte> meaning;  ///< handles: Frame::provide
    std::size_t bytes = 0;
    bool handle = false;

    gpu::Buffer& now() const { return *copies[std::size_t(current)]; }
    gpu::Buffer& last() const { return *copies[std::size_t(previous)]; }
};

class PortMemories {
public:
    PortMemories(const gpu::Device& device, const Graph& graph, const Plan& plan, glm::uvec2 frame);
    PortMemory& at(std::size_t resource) { return memories_[resource]; }
    const PortMemory& at(std::size_t resource) const { return memories_[resource]; }
    /// Scratch gets memory for so many bytes; returns what it had, which must live as long as commands that name it (nothing, if that will do).
    std::unique_ptr<gpu::Buffer> reserve(const gpu::Device& device, std::size_t resource, std::size_t bytes, const std::string& name);
    /// Zero everywhere (`all`), or only in what lives from frame to frame.
    void clear(gpu::Commands& commands, const Plan& plan, bool all);
    std::size_t bytes() const { return bytes_; }

private:
    std::vector<std::unique_ptr<gpu::Buffer>> buffers_;
    std::vector<PortMemory> memories_;  ///< parallel to Plan::resources
    std::size_t bytes_ = 0;
};

}  // namespace lodestir
