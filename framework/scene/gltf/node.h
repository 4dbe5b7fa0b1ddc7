// SPDX-License-Identifier: MIT
// Nodes of a glTF model: hierarchy, instances with their levels of detail, punctual lights, the camera.
#pragma once
#include <framework/scene/gltf/import.h>

namespace lodestir {

/// Appends the nodes of the file's scene under `parent` and loads the meshes they use, each once for each chain of levels.
/// A node with MSFT_lod has the meshes of the nodes it names as its coarser levels (placed relative to the node itself); those nodes
/// are not instanced. Errors of the levels are read from the node's extras, `"lod_error": [0, e1, e2, ...]` in object units, and
/// `"MSFT_screencoverage"`.
/// Cycles, nodes with two parents and children, meshes and levels that are not there are gathered as problems; lights, cameras and skins
/// that are not there, or are none, are left out with a note.
void loadGltfNodes(GltfImport& import, std::uint32_t parent);

}  // namespace lodestir
