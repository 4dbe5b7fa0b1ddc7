// SPDX-License-Identifier: MIT
// A spaceship blown from solid glass. What is inside is embedded: metal and glowing filaments in the glass itself; a cockpit and a reactor in bubbles of
// air, the reactor a ball of glass around a star. No two solids overlap, so every surface parts glass from air.
#pragma once

#include "glb.h"

namespace lodestir::generate {

/// What it is made of: material indices.
struct ShipMaterials {
    int hull, wing, amber, violet;  ///< solid glass
    int gold, steel, leather, dark;
    int star, plasma, panel;  ///< glowing
};

/// The ship around the origin, its nose along +x; 7.6 m long, 6.6 m across its wings.
Model glassShip(const ShipMaterials& materials);

/// Half extents of the hull across, at a place along it: y and z.
glm::vec2 shipGirth(float x);

}  // namespace lodestir::generate
