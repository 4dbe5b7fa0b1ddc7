// SPDX-License-Identifier: MIT
// Wooden parts: planks, bent boards and turned legs, with grain along their length.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "mesh.h"
#include "shapes.h"

namespace lodestir::generate {

/// A board centred on the origin, its UVs on a paintPanel picture; each seed is cut from another place of the panel.
Mesh plank(const glm::vec3& size, Axis grain, uint32_t seed, float radius = 0.003f, int divisions = 1);

/// A round bar from one point to another, with rounded ends.
Mesh rod(const glm::vec3& from, const glm::vec3& to, float radiusFrom, float radiusTo, uint32_t seed);

}  // namespace lodestir::generate
