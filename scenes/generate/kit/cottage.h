// SPDX-License-Identifier: MIT
// Small houses with pitched roofs, painted shutters and a chimney, and a village church.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "glb.h"

namespace lodestir::generate {

/// What a house is painted with: material indices.
struct CottagePaints {
    int wall, roof, trim, shutter, pane, chimney;
};

/// A house that stands on the origin, its door facing +z. `size`: width, height of the walls, depth; metres.
Model cottage(const std::string& name, const CottagePaints& paints, const glm::vec3& size, float pitch = 1.0f);

/// A nave and a tower with a pointed spire, its door facing +z.
Model church(const std::string& name, const CottagePaints& paints);

}  // namespace lodestir::generate
