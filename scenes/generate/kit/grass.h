// SPDX-License-Identifier: MIT
// Heath plants made of thin triangles: tufts of bent, tapering blades, and low shrubs.
#pragma once

#include <cstdint>

#include "mesh.h"

namespace lodestir::generate {

/// What a tuft is made of.
struct Tuft {
    int blades = 70;
    float height = 0.2f;   ///< metres
    float radius = 0.09f;  ///< of the ground the blades are rooted in, metres
    float dryness = 0.7f;  ///< share of straw among green blades
};

/// Blades rooted around the origin. Colours are in the vertices: dark roots, straw or green tips.
Mesh grassTuft(uint32_t seed, const Tuft& tuft);

/// A low bush: small pointed leaves around a few domes, about 1 m across.
Mesh shrub(uint32_t seed, int leaves);

}  // namespace lodestir::generate
