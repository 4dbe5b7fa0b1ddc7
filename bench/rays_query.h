// SPDX-License-Identifier: MIT
// Acceleration structures of the driver over a scene, for its own ray query.
#pragma once
#include <bench/rays_scenes.h>
#include <framework/gpu/acceleration.h>

#include <memory>
#include <vector>

namespace lodestir::bench {

class QueryScene {
public:
    QueryScene(const gpu::Device& device, const RayScene& scene) {
        std::vector<gpu::TriangleGeometry> geometries;
        for (const Triangles& mesh : scene.meshes)
            geometries.push_back({.positions = keep(gpu::makeBuffer(device, std::as_bytes(std::span(mesh.positions)), "positions")),
                                  .indices = keep(gpu::makeBuffer(device, std::as_bytes(std::span(mesh.triangles)), "triangles")),
                                  .vertices = std::uint32_t(mesh.positions.size()),
                                  .triangles = std::uint32_t(mesh.triangles.size())});
        meshes_ = gpu::buildBottomLevels(device, geometries);
        std::vector<VkAccelerationStructureInstanceKHR> instances;
        for (const Placed& placed : scene.instances) {
            VkAccelerationStructureInstanceKHR& i = instances.emplace_back();
            for (int row = 0; row < 3; ++row)
                for (int column = 0; column < 4; ++column) i.transform.matrix[row][column] = placed.toWorld[column][row];
            i.mask = 0xff;
            i.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
            i.accelerationStructureReference = meshes_[placed.mesh]->address();
        }
        top_ = gpu::makeTopLevel(device, keep(gpu::makeBuffer(device, std::as_bytes(std::span(instances)), "instances")), std::uint32_t(instances.size()));
        gpu::runOnce(device, [&](gpu::Commands& commands) { top_->build(commands); });
    }

    VkDeviceAddress address() const { return top_->address(); }

private:
    VkDeviceAddress keep(gpu::Buffer buffer) { return buffers_.emplace_back(std::move(buffer)).address(); }

    std::vector<gpu::Buffer> buffers_;
    std::vector<std::unique_ptr<gpu::AccelerationStructure>> meshes_;
    std::unique_ptr<gpu::AccelerationStructure> top_;
};

}  // namespace lodestir::bench
