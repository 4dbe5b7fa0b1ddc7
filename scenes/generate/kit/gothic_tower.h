// SPDX-License-Identifier: MIT
// A tower of a bridge after the manner of the Gothic: corner turrets with spires, lancet windows some of which are lit, a steep roof.
#pragma once

#include <cstdint>
#include <string>

#include <glm/glm.hpp>

#include "glb.h"

namespace lodestir::generate {

/// What it is built of: material indices.
struct TowerPaints {
    int stone, trim, roof, gilt, glass, lit;
};

/// Its proportions, metres.
struct TowerForm {
    glm::vec3 size{14, 40, 16};  ///< of the body, without turrets and roof
    float turret = 1.9f;         ///< radius
    float roofHeight = 15;
    float passage = 8;  ///< width of the arched way through it along x; its height follows
    int storeys = 3;    ///< of windows above the passage
    uint32_t seed = 1;  ///< which windows are lit
};

/// A tower that stands on the origin; the way through it runs along x.
Model gothicTower(const std::string& name, const TowerPaints& paints, const TowerForm& form);

/// A flat window with a pointed head around the origin of its sill, facing +z.
Mesh lancet(float width, float height);

}  // namespace lodestir::generate
