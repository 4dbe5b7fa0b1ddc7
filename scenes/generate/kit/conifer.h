// SPDX-License-Identifier: MIT
// Spruces: a straight stem, whorls of drooping boughs, needles in sprays. Colours are in the vertices.
#pragma once

#include <cstdint>

#include "mesh.h"

namespace lodestir::generate {

/// A tree 1 tall that stands on the origin, of some 2,000 triangles. It has to be seen from both sides.
Mesh spruce(uint32_t seed);

}  // namespace lodestir::generate
