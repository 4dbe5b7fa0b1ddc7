// SPDX-License-Identifier: MIT
// The driver's acceleration structures over the levels of a scene's meshes, for ray queries.
#pragma once
#include <framework/gpu/acceleration.h>
#include <framework/scene/upload/geometry.h>

#include <map>
#include <memory>
#include <vector>

namespace lodestir {

class BottomLevels {
public:
    /// Structures as of one pose.
    struct Table {
        gpu::Buffer addresses;  ///< of mesh m at level l: 64 bits at m * LEVELS + l, as in Geometry::levels; 0: no triangles
        std::vector<std::shared_ptr<const gpu::AccelerationStructure>> structures;
    };

    BottomLevels(const gpu::Device& device, const Geometry& geometry);
    /// Builds anew what deforms, and at the first time the rest, from the geometry's positions as they lie at `positions`.
    std::shared_ptr<const Table> build(const Scene& scene, const Geometry& geometry, VkDeviceAddress positions);

private:
    const gpu::Device& device_;
    gpu::Buffer indices_;  ///< three for each of Geometry::primitives
    std::map<std::uint32_t, std::shared_ptr<const gpu::AccelerationStructure>> rigid_;  ///< by the first primitive of the level
};

}  // namespace lodestir
