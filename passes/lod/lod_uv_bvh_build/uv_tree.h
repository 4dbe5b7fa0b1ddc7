// SPDX-License-Identifier: MIT
// A binary tree of boxes in UV over the triangles of a mesh level.
#pragma once
#include <framework/scene/scene.h>
#include <passes/lod/uv_index.h>

#include <span>
#include <vector>

namespace lodestir {

/// Trees of all mesh levels one behind the other: UvIndex's arrays.
struct UvTrees {
    std::vector<UvNode> nodes;
    std::vector<std::uint32_t> primitives, roots;
};

/// Adds the tree of a level and returns its root. `order`: the level's triangles as they lie on the GPU from `firstPrimitive` on. Triangles
/// without area in UV are left out: no map can be told through them. The tree is at most 31 nodes deep.
std::uint32_t addUvTree(UvTrees& trees, const MeshLevel& level, std::span<const std::uint32_t> order, std::uint32_t firstPrimitive);

}  // namespace lodestir
