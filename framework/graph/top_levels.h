// SPDX-License-Identifier: MIT
// The driver's top level over each World that a pass hands out, for ray queries: made after the pass, because it may have chosen levels.
#pragma once
#include <framework/gpu/acceleration.h>
#include <framework/gpu/pipeline.h>
#include <framework/shaders/world/world.h>

#include <memory>
#include <vector>

namespace lodestir {

class TopLevels {
public:
    explicit TopLevels(const gpu::Device& device);

    /// Sets `world.tlas` to a structure that `record` will build of the World as it lies at `place`; returns what keeps its memory alive.
    std::shared_ptr<const void> add(World& world, VkDeviceAddress place);
    /// Builds what was added since the last call; what comes next sees it.
    void record(gpu::Commands& commands);

private:
    struct Structure {
        gpu::Buffer instances;
        std::unique_ptr<gpu::AccelerationStructure> top;
        std::uint32_t count = 0;
        VkDeviceAddress world = 0;
    };
    const gpu::Device& device_;
    gpu::Pipeline listInstances_;
    std::vector<std::shared_ptr<Structure>> waiting_;
};

}  // namespace lodestir
