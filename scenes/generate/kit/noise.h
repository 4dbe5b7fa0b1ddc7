// SPDX-License-Identifier: MIT
// Lattice noise in three dimensions: gradient, fractal, ridged and cellular, with optional wrap-around for tiles.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace lodestir::generate {

/// What lies around a point in cellular noise. Distances in lattice units.
struct Cell {
    float nearest = 0;  ///< distance to the nearest feature point
    float second = 0;   ///< distance to the second nearest
    uint32_t id = 0;    ///< hash of the nearest feature's lattice cell
};

/// Gradient noise (Perlin, "Improving Noise", 2002) keyed by a seed.
/// With a period > 0 on an axis the noise repeats after that many lattice units (per octave: period * 2^octave).
struct Noise {
    uint32_t seed = 0;
    glm::ivec3 period{0};

    /// One octave, about [-1, 1], zero mean, zero on lattice points.
    float at(const glm::vec3& p) const { return octave(p, 0); }

    /// Sum of octaves at doubling frequency; each is `gain` times as strong as the one before; normalised to about [-1, 1].
    float fractal(const glm::vec3& p, int octaves, float gain = 0.5f) const;

    /// Ridges: 1 - |noise| squared, each octave weighted by the one before so that detail gathers on crests
    /// (Musgrave's ridged multifractal). About [0, 1].
    float ridged(const glm::vec3& p, int octaves, float gain = 0.5f) const;

    /// Cellular noise (Worley 1996): one jittered feature point per lattice cell.
    Cell cell(const glm::vec3& p) const;

private:
    float octave(const glm::vec3& p, int level) const;
};

}  // namespace lodestir::generate
