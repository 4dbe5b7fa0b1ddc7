// SPDX-License-Identifier: MIT
// Pictures to hang on a wall.
#pragma once

#include <cstdint>

#include "picture.h"

namespace lodestir::generate {

/// Overlapping arcs and discs in earth colours on paper, after the manner of mid-century prints.
Textures paintPrint(uint32_t seed, int width, int height);

/// Misty ranges of hills behind each other, in ink wash.
Textures paintHills(uint32_t seed, int width, int height);

}  // namespace lodestir::generate
