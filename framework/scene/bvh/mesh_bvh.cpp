// SPDX-License-Identifier: MIT
#include <framework/scene/bvh/mesh_bvh.h>

#include <framework/scene/panes.h>

namespace lodestir {

Bvh meshBvh(const Scene& scene, const Mesh& mesh, std::size_t level) {
    const MeshLevel& shape = mesh.levels[level];
    const bool panes = lightsShineThroughPanes(scene);
    std::vector<bool> asked;
    for (const Material& m : scene.materials) asked.push_back(m.alphaMode == AlphaMode::mask || (panes && isPane(m)));
    std::vector<std::uint32_t> masks(shape.triangles.size(), 0);
    for (std::size_t t = 0; t < masks.size(); ++t)
        if (asked[shape.materials[t]]) masks[t] = shape.materials[t] + 1;
    return cachedBvh({shape.positions, shape.triangles, masks, boundsOf(mesh)});
}

}  // namespace lodestir
