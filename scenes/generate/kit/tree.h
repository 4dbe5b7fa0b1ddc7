// SPDX-License-Identifier: MIT
// Trees as a painter puts them down: a trunk with a few boughs, and a crown of dabs. Colours are in the vertices.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "mesh.h"

namespace lodestir::generate {

/// How a tree grows.
struct TreeForm {
    float height = 5;                       ///< metres
    float spread = 1.7f;                    ///< radius of the crown, metres
    float waist = 0.55f;                    ///< where the crown is widest, as a share of its height
    float bare = 0.25f;                     ///< share of the height below the crown
    int dabs = 1600;                        ///< two triangles each
    float dab = 0.17f;                      ///< length of one, metres
    glm::vec3 shade{0.03f, 0.06f, 0.03f};   ///< colour within the crown
    glm::vec3 light{0.20f, 0.30f, 0.07f};   ///< colour of its outside
    glm::vec3 accent{0.40f, 0.42f, 0.10f};  ///< of a few dabs at the very outside
};

/// A tree that stands on the origin. It has to be seen from both sides.
Mesh tree(uint32_t seed, const TreeForm& form);

/// A patch of flowers about `radius` metres wide: stems, and heads of five petals in two colours.
Mesh flowerPatch(uint32_t seed, int count, float radius, const glm::vec3& petals, const glm::vec3& others);

}  // namespace lodestir::generate
