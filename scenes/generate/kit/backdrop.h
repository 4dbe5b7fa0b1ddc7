// SPDX-License-Identifier: MIT
// What a single thing is shown on, before and under.
#pragma once

#include "glb.h"
#include "wood.h"

namespace lodestir::generate {

struct TableTop {
    glm::vec3 size;
    float edge;        ///< radius of its rounded edges
    glm::vec3 centre;
    float grain;  ///< panels (panelSize) a metre
    const char* material;
    Wood wood;
    uint32_t seed;  ///< of the wood's picture
};

/// A wooden table top as node "table".
void addTable(Glb& glb, const TableTop& table);

/// A plain rectangle as node "wall", through its upper-left corner, with edges to the right and down.
void addWall(Glb& glb, const Material& paint, const glm::vec3& corner, const glm::vec3& right, const glm::vec3& down);

/// A glowing sheet as node "lamp", above and aside of a thing of `radius` around `centre`: out of the picture of a camera that looks along -z.
void addLamp(Glb& glb, const glm::vec3& centre, float radius, const glm::vec3& radiance);

}  // namespace lodestir::generate
