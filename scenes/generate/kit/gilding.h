// SPDX-License-Identifier: MIT
// Gilded ornament: reliefs of gold leaf on paint, and a painted ceiling.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "picture.h"

namespace lodestir::generate {

/// A frieze of rosettes between scrolls, beads along its rims; u runs along it and repeats, v from rim to rim. For a band 1.2 m x 0.8 m.
Textures paintFrieze(const glm::vec3& ground, uint32_t seed, int width);
constexpr glm::vec2 friezeSize{1.2f, 0.8f};

/// Gold leaf on worn wood: uneven gloss, and bole that shows through at places. Repeats after 1 m.
Textures paintGoldLeaf(uint32_t seed, int width);

/// A round ceiling in its square: a painted sky in a ring of panels, gilt ribs between them. The circle has the radius of half the picture.
Textures paintCeiling(uint32_t seed, int width, float metres);

}  // namespace lodestir::generate
