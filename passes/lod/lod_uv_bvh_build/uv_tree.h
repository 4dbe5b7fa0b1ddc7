// SPDX-License-Identifier: MIT
// Binary trees of boxes in UV over the triangles of mesh levels.
#pragma once
#include <framework/pass/scene.h>
#include <passes/lod/uv_index.h>

#include <cstdint>
#include <vector>

namespace lodestir {

/// Trees of all mesh levels one behind the other: UvIndex's arrays.
struct UvTrees {
    std::vector<UvNode> nodes;
    std::vector<std::uint32_t> primitives, roots;
};

/// The trees of all meshes that show several levels. Triangles without area in UV are left out: no map can be told through them. Trees are at
/// most 31 nodes deep.
UvTrees uvTrees(const SceneRecords& scene);

}  // namespace lodestir
