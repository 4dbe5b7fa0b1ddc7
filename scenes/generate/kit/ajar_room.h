// SPDX-License-Identifier: MIT
// The room of "Robust Monte Carlo Methods for Light Transport Simulation" (Veach 1997, section 11.5): all its light comes through a door ajar.
#pragma once

#include "glb.h"

namespace lodestir::generate {

/// The room and the lit one behind it. `wallMetal`: the walls of the dark room are of rough metal instead of plaster.
Glb ajarRoom(bool wallMetal);

}  // namespace lodestir::generate
