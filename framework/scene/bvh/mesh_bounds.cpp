// SPDX-License-Identifier: MIT
#include <framework/scene/bvh/mesh_bounds.h>

namespace lodestir {

Box boundsOf(const Mesh& mesh) {
    Box box;
    for (const MeshLevel& level : mesh.levels) box.add(boundsOf(level.positions));
    return box;
}

glm::dvec3 extentOf(const Mesh& mesh) {
    const Box box = boundsOf(mesh);
    return box.isEmpty() ? glm::dvec3(0) : glm::dvec3(box.high) - glm::dvec3(box.low);
}

}  // namespace lodestir
