// SPDX-License-Identifier: MIT
// Smooth curves in space, for what is swept along them.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "mesh.h"
#include "shapes.h"

namespace lodestir::generate {

/// A smooth curve through stations (uniform Catmull-Rom, positions and radii alike), `steps` a span.
std::vector<Station> spline(std::span<const Station> stations, int steps);

/// A tube along spline(stations, steps).
Mesh limb(std::span<const Station> stations, int steps, int sides);

/// Sweeps an open profile along a path without roll: a point (x, y) of the profile stands x to the right of the walker and y up. UVs in metres, u along
/// the path, v along the profile, which runs from the left of its outer side to the right: (-1, 0), (0, 1), (1, 0) is a ridge.
Mesh moulding(std::span<const glm::vec3> path, std::span<const glm::vec2> profile, float creaseDegrees = 40);

/// Points of a hanging cord between two places that sags by `sag` metres in its middle; `count` spans.
std::vector<glm::vec3> cord(const glm::vec3& from, const glm::vec3& to, float sag, int count);

}  // namespace lodestir::generate
