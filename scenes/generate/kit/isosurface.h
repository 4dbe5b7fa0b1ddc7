// SPDX-License-Identifier: MIT
// Triangles of an implicit surface, of one size everywhere, as a scanner's are.
#pragma once

#include <functional>

#include <glm/glm.hpp>

#include "mesh.h"

namespace lodestir::generate {

/// Below 0 inside, in metres; nowhere more than the distance to the surface. Called by several threads.
using Distance = std::function<float(const glm::vec3&)>;

/// The surface of `distance` inside the box, in cells of `step` metres: one vertex a cell, in the middle of where the surface crosses its edges
/// (Gibson, "Constrained elastic surface nets", 1998, section 2, without the relaxation). Smooth normals, no UVs, outside is counter-clockwise. The box
/// must hold the whole surface.
Mesh isosurface(const Distance& distance, const glm::vec3& low, const glm::vec3& high, float step);

}  // namespace lodestir::generate
