// SPDX-License-Identifier: MIT
// Dressed stone: marble, floors of it, walls of squared blocks.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "picture.h"

namespace lodestir::generate {

/// Colours of a marble: its ground and its veins.
struct Marble {
    glm::vec3 ground, vein;
    float roughness = 0.16f;
};
Marble carrara();
Marble verde();

/// One slab; repeats after slabSize metres.
Textures paintMarble(const Marble& marble, uint32_t seed, int width);
constexpr float slabSize = 3.0f;

/// A floor of square tiles in two marbles, polished; repeats after four tiles of 0.8 m.
Textures paintMarbleFloor(const Marble& light, const Marble& dark, uint32_t seed, int width);
constexpr float marbleFloorSize = 3.2f;

/// A wall of squared blocks in courses of 0.45 m; repeats after 3.6 m.
Textures paintAshlar(const glm::vec3& color, uint32_t seed, int width);
constexpr float ashlarSize = 3.6f;

}  // namespace lodestir::generate
