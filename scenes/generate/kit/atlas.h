// SPDX-License-Identifier: MIT
// Pictures for shapes that have no charts of their own: cuts a mesh into pieces that face one axis each, and paints what a place is onto them.
#pragma once

#include <functional>

#include "mesh.h"
#include "picture.h"

namespace lodestir::generate {

/// `mesh` in charts that share a square picture of `texels` a side without overlap: each a connected piece, projected along the axis that it faces.
/// Vertices are split along seams; positions and normals stay. Has tangents. Pieces of fewer than `smallest` triangles join a neighbour where they can:
/// they are not worth their gutter, and coarse levels of detail lose them.
Mesh charted(const Mesh& mesh, int texels, int smallest = 40);

/// Pictures for a mesh of charted(). `surface` says what a place is; heights are metres along the normal.
Textures bake(const Mesh& charted, int texels, const std::function<Surface(const glm::vec3& position, const glm::vec3& normal)>& surface);

}  // namespace lodestir::generate
