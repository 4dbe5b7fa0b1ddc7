// SPDX-License-Identifier: MIT
// Mineral surfaces: stone tiles, plaster, concrete.
#pragma once

#include <cstdint>

#include "picture.h"

namespace lodestir::generate {

/// Polished slate tiles of 0.6 m with pale grout; repeats after 2.4 m.
Textures paintSlate(uint32_t seed, int width);
constexpr float slateSize = 2.4f;

/// Trowelled plaster in one colour; repeats after 2 m.
Textures paintPlaster(const glm::vec3& color, uint32_t seed, int width);
constexpr float plasterSize = 2.0f;

/// Glazed earthenware with faint rings from the wheel; for pots. Repeats after 0.5 m.
Textures paintEarthenware(const glm::vec3& color, uint32_t seed, int width);
constexpr float earthenwareSize = 0.5f;

}  // namespace lodestir::generate
