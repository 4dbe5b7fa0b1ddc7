// SPDX-License-Identifier: MIT
// Lattice girders of bars.
#pragma once

#include <span>

#include <glm/glm.hpp>

#include "mesh.h"

namespace lodestir::generate {

/// A lattice between two chords that run through matching points: posts between them, and crossed braces in each bay.
Mesh lattice(std::span<const glm::vec3> upper, std::span<const glm::vec3> lower, float chordRadius, float braceRadius);

/// A straight girder between two places at its foot, `height` tall, of `bays` bays.
Mesh girder(const glm::vec3& from, const glm::vec3& to, float height, int bays, float chordRadius, float braceRadius);

}  // namespace lodestir::generate
