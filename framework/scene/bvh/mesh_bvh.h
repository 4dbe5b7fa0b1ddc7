// SPDX-License-Identifier: MIT
// The BVH of a mesh level, and with it the order in which its triangles lie on the GPU.
#pragma once
#include <framework/scene/bvh/bvh.h>
#include <framework/scene/bvh/mesh_bounds.h>
#include <framework/scene/scene.h>

namespace lodestir {

/// BvhTriangle::mask of each triangle; empty where no material asks for one.
std::vector<std::uint32_t> triangleMasks(const Scene& scene, const MeshLevel& level);

/// From the cache on disk where it was built before. World.primitives holds the triangles in Bvh::order, level after level, mesh after mesh.
LODESTIR_API Bvh meshBvh(const Scene& scene, const Mesh& mesh, std::size_t level);

}  // namespace lodestir
