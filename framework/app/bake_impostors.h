// SPDX-License-Identifier: MIT
// Impostors of a model's meshes, made ahead of the runs that find them in the cache.
#pragma once
#include <framework/graph/description.h>
#include <framework/graph/renderer.h>

#include <string>
#include <vector>

namespace lodestir {

struct BakeOptions {
    RendererOptions renderer;
    std::vector<Setting> set;         ///< of the pass "bake" of graphs/framework/bake_impostors.json
    std::vector<std::string> meshes;  ///< only those of these names; none: all that instances show
};

struct BakedMesh {
    std::string name;
    std::size_t meshes = 1;  ///< of this name
    int views = 0, resolution = 0;
    std::uint64_t bytes = 0, rawBytes = 0;  ///< as they are kept, and if nothing was compressed
    double coverage = 0;  ///< share of points spread evenly over it that at least one view sees
    double seconds = 0;   ///< on the device
    bool wasKept = false;  ///< found in the cache, not baked
};

/// With a line of progress. Error for a mesh that the model doesn't show.
std::vector<BakedMesh> bakeImpostors(const Path& model, const BakeOptions& options);

}  // namespace lodestir
