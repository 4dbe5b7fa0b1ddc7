// SPDX-License-Identifier: MIT
// Moving water, held still: a sheet of waves that run mostly one way.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "mesh.h"

namespace lodestir::generate {

/// Waves of a sheet of water.
struct Waves {
    float length = 0.6f;   ///< of the longest, metres
    float height = 0.01f;  ///< metres, from the mean
    float heading = 0;     ///< radians from +x towards +z: where they run to
    uint32_t seed = 1;
};

/// A sheet over x from low.x to high.x and z from low.y to high.y, y about 0, in cells of `cell` metres.
Mesh waterSheet(const glm::vec2& low, const glm::vec2& high, float cell, const Waves& waves);

}  // namespace lodestir::generate
