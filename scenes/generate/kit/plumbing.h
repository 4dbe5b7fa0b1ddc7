// SPDX-License-Identifier: MIT
// What water runs through and into: taps, a shower, basins and tubs. Taps and basins stand on y = 0; a shower hangs on the wall z = 0.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "glb.h"

namespace lodestir::generate {

/// A single-lever mixer whose spout arches to +z, `height` tall.
Model tap(const std::string& name, int metal, float height, float reach);

/// A shower at the wall z = 0, its foot at y = 0.95: thermostat, riser, and a round head at `height`, `reach` before the wall.
Model shower(const std::string& name, int metal, float height, float reach);

/// A thick-walled vessel open above: a basin or a tub. Footprint of `size` (x, z), rounded as a superellipse of power `square` (2: an ellipse).
Model basin(const std::string& name, int enamel, const glm::vec3& size, float square);

}  // namespace lodestir::generate
