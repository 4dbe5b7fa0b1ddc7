// SPDX-License-Identifier: MIT
// The bar that drawers and doors are pulled by.
#pragma once

#include <glm/glm.hpp>

#include "mesh.h"

namespace lodestir::generate {

/// A round bar from one point of a face to another, held off it on two posts that reach along `out`.
Mesh grip(const glm::vec3& from, const glm::vec3& to, const glm::vec3& out, float radius);

}  // namespace lodestir::generate
