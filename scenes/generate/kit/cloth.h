// SPDX-License-Identifier: MIT
// Woven things: an undyed weave for upholstery and curtains, a patterned rug, and hanging folds.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "mesh.h"
#include "picture.h"

namespace lodestir::generate {

/// A coarse basket weave, nearly white, to be dyed by the material's colour; repeats after 0.16 m.
Textures paintWeave(uint32_t seed, int width);
constexpr float weaveSize = 0.16f;

/// A wool rug: cream field with dark lozenges inside a border. The picture covers the whole rug of `metres`.
Textures paintRug(uint32_t seed, int width, const glm::vec2& metres);

/// A curtain of `width` x `height` hanging in folds from its upper edge at y = 0, spread along x; folds deepen towards the hem. UVs in
/// metres.
Mesh curtain(uint32_t seed, float width, float height);

/// The rug itself, lying on y = 0: a slab with softly waved top and fringes at its short (x) ends. UVs span the picture.
Mesh rug(uint32_t seed, const glm::vec2& metres);

}  // namespace lodestir::generate
