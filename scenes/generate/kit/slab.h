// SPDX-License-Identifier: MIT
// A box between two corners: walls, floors and steps of what is built from them.
#pragma once

#include <glm/glm.hpp>

#include "mesh.h"

namespace lodestir::generate {

/// The box from `low` to `high`, edges rounded by `bevel` (0: sharp), its UVs in repeats of a picture that spans `repeat` metres.
Mesh slab(const glm::vec3& low, const glm::vec3& high, float repeat, float bevel = 0);

}  // namespace lodestir::generate
