// SPDX-License-Identifier: MIT
#include <framework/scene/bvh/mesh_bvh.h>

#include <framework/scene/panes.h>

#include <algorithm>

namespace lodestir {

std::vector<std::uint32_t> triangleMasks(const Scene& scene, const MeshLevel& level) {
    const bool panes = lightsShineThroughPanes(scene);
    std::vector<bool> asked;
    for (const Material& m : scene.materials) asked.push_back(m.alphaMode == AlphaMode::mask || (panes && isPane(m)));
    std::vector<std::uint32_t> masks;
    if (std::ranges::find(asked, true) == asked.end()) return masks;
    for (const std::uint32_t material : level.materials) masks.push_back(asked[material] ? material + 1 : 0);
    return masks;
}

Bvh meshBvh(const Scene& scene, const Mesh& mesh, std::size_t level) {
    const MeshLevel& shape = mesh.levels[level];
    const std::vector<std::uint32_t> masks = triangleMasks(scene, shape);
    return cachedBvh({shape.positions, shape.triangles, masks, boundsOf(mesh)});
}

}  // namespace lodestir
