// SPDX-License-Identifier: MIT
// A beast that walks upright in a coat of overlapping plates, with horns, long ears, claws and a heavy tail. Faces +x, 1.3 m tall; its soles are pressed
// a little below y = 0.
#pragma once

#include <string>

#include "glb.h"

namespace lodestir::generate {

/// `cell`: metres between vertices; at 0.0064 it has some 214,000 triangles. Charts are large and follow the body, not its plates, so that levels of
/// detail down to a hundredth of the triangles keep them.
Model creature(Glb& glb, const std::string& name, float cell);

}  // namespace lodestir::generate
