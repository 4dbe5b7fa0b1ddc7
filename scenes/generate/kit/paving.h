// SPDX-License-Identifier: MIT
// What squares and quays are paved with.
#pragma once

#include <cstdint>

#include "picture.h"

namespace lodestir::generate {

/// Rounded setts in rows after rain: wet stone, and puddles where the ground is low. Repeats after 4 m.
Textures paintWetSetts(uint32_t seed, int width);
constexpr float settsSize = 4.0f;

}  // namespace lodestir::generate
