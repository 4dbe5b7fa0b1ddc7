// SPDX-License-Identifier: MIT
// The one rule that ties directions to texels of an environment map, and the reading of maps.
//
//     u = fract((atan2(d.x, -d.z) + rotation) / (2 pi) + 0.5),   v = acos(d.y) / pi
//
// d is a unit vector of the world, +Y up; (u, v) = (0, 0) is the corner of the first texel, rows go down, columns to the right.
// Row 0 is +Y. Without rotation the middle column looks along -Z and the columns right of it towards +X, as a viewer who looks along
// -Z sees them. `rotation` turns the surroundings about +Y by the right hand, like a model that is turned by the same angle.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

LODESTIR_API glm::vec2 environmentUv(glm::vec3 direction, float rotation);
LODESTIR_API glm::vec3 environmentDirection(glm::vec2 uv, float rotation);

/// Solid angle of any texel of a row, steradians, exact.
LODESTIR_API double texelSolidAngle(int row, int width, int height);

/// Irradiance of a surface that faces `normal`: sum over the texels of radiance * max(cos, 0) * solid angle.
LODESTIR_API glm::vec3 environmentIrradiance(const Environment& environment, glm::vec3 normal);

/// Reads an .exr or .hdr map in equirectangular projection. Texels that are negative or not finite become black; the note says how
/// many. Error when the file cannot be read or has fewer than 3 channels.
LODESTIR_API Environment loadEnvironmentMap(const Path& path, std::vector<std::string>& notes);

}  // namespace lodestir
