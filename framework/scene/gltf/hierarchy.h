// SPDX-License-Identifier: MIT
// Which nodes of a glTF file are in its scene, in an order that has parents before children.
#pragma once
#include <framework/scene/gltf/import.h>

namespace lodestir {

struct GltfVisit {
    int node = 0;
    int parent = -1;  ///< node of the file, -1: a root of the scene
};

/// Nodes of the default scene (the first one where none is named; all roots where there is none), without those that stand
/// for coarser levels of another node. Error when the hierarchy is none.
std::vector<GltfVisit> visitGltfScene(const GltfFile& file);

/// The nodes of the file that MSFT_lod of `node` names as coarser levels, finer to coarser. Error when they do not exist.
std::vector<int> coarserLevels(const GltfFile& file, int node);

}  // namespace lodestir
