// SPDX-License-Identifier: MIT
// A cat of cast bronze that sits upright and looks along +x, its tail laid around its feet: a collar of gold, verdigris in its hollows. On y = 0, 1 m tall.
#pragma once

#include <string>

#include "glb.h"

namespace lodestir::generate {

/// All of one mesh and one material; `cell`: metres of the lattice it is modelled on, 0.0052 for 165,000 triangles.
Model cat(Glb& glb, const std::string& name, float cell);

}  // namespace lodestir::generate
