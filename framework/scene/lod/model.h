// SPDX-License-Identifier: MIT
// Gives the meshes of a glTF model chains of levels, written as MSFT_lod of the nodes that show them.
#pragma once
#include <framework/scene/lod/chain.h>

namespace lodestir {

struct LodModelOptions {
    LodChainOptions chain;
    std::vector<std::string> meshes;  ///< names; empty: all
};

/// What became of one mesh of the model.
struct LodMeshFacts {
    std::string name;
    std::size_t nodes = 0;  ///< that show it
    std::size_t triangles = 0;
    LodChain chain;  ///< without triangles and groups
    std::vector<std::size_t> coarserTriangles;
    std::vector<float> coverages;
    std::vector<std::string> notes;
};

struct LodModel {
    std::vector<std::byte> glb;
    std::vector<LodMeshFacts> meshes;
    std::vector<std::string> notes;
};

/// Reads a model, builds the chains and returns the model with them as the bytes of a GLB file. All else of the model stays as it is;
/// vertices are shared by all levels, but for their colours. Meshes that emit, and nodes that have levels already, are left alone; unlit
/// surfaces are no lights. Each node with levels gets
/// `extensions.MSFT_lod.ids`, `extras.MSFT_screencoverage`, `extras.lod_error` and, with UVs, `extras.lod_uv_error`.
/// Error with everything that is wrong with the model.
LODESTIR_API LodModel buildLodModel(const Path& path, const LodModelOptions& options);

}  // namespace lodestir
