// SPDX-License-Identifier: MIT
// Wood: annual rings cut along the log, fibres and pores; single boards, planked and herringbone floors.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "picture.h"

namespace lodestir::generate {

/// A kind of timber.
struct Wood {
    glm::vec3 early;          ///< pale spring growth, linear reflectance
    glm::vec3 late;           ///< dark summer growth
    float roughness = 0.45f;  ///< of the varnish
    float pores = 1;          ///< depth and darkness of pores (oak 1, maple 0.2)
};

Wood oak();
Wood walnut();
Wood birch();

/// One point of a board. `p` in metres, x along the grain, y across from the board's middle; every `board` is cut from another place.
Surface boardAt(const Wood& wood, const glm::vec2& p, uint32_t board);

/// Edge-glued boards, 0.15 m wide and running along x; repeats after 1.2 m x 0.6 m. For furniture.
Textures paintPanel(const Wood& wood, uint32_t seed, int width);

/// Size of a paintPanel picture on the surface, metres.
constexpr glm::vec2 panelSize{1.2f, 0.6f};

/// Herringbone of blocks 0.09 m x 0.45 m; repeats after 1.8 m both ways.
Textures paintHerringbone(const Wood& wood, uint32_t seed, int width);
constexpr float herringboneSize = 1.8f;

}  // namespace lodestir::generate
