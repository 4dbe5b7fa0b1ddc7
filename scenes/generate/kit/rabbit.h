// SPDX-License-Identifier: MIT
// A rabbit that sits up facing +x, one ear laid back: deep hollows, legs and ears before what lies behind. On y = 0, 0.45 m tall.
#pragma once

#include <string>

#include "glb.h"

namespace lodestir::generate {

/// All of one mesh and one material; `cell`: metres of the lattice it is modelled on, 0.002 for 200,000 triangles.
Model rabbit(Glb& glb, const std::string& name, float cell);

}  // namespace lodestir::generate
