// SPDX-License-Identifier: MIT
// Round arches and what carries them: columns, pierced walls, vaults. Metres, UVs in metres.
#pragma once

#include <glm/glm.hpp>

#include "mesh.h"

namespace lodestir::generate {

/// A column that stands on the origin: plinth, base, shaft with a slight swell, capital and abacus. `radius` is that of the shaft's foot.
Mesh column(float height, float radius);

/// A piece of wall that faces +z, centred in x, its foot at y = 0, with a round-arched opening in its middle.
struct ArchBay {
    float width, height;  ///< of the wall
    float opening;        ///< width of the opening
    float sill = 0;       ///< height its opening begins at
    float spring;         ///< height at which the arch begins; its radius is half the opening
    bool afloat = false;  ///< nothing below the sill: the wall rests on columns there
    float depth = 0.4f;   ///< thickness; the wall lies half before and half behind z = 0
};
Mesh archBay(const ArchBay& bay);

/// The round moulding around the opening of a bay, on its front side.
Mesh archivolt(const ArchBay& bay, float radius);

/// Half a cylinder of `radius` over z from `back` to `front`, seen from below, springing at height 0. UVs in metres.
Mesh barrelVault(float radius, float back, float front, int segments);

}  // namespace lodestir::generate
