// SPDX-License-Identifier: MIT
// Trees as a painter puts them down: a trunk with a few boughs, and a crown of dabs. Colours are in the vertices.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "glb.h"
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

/// A cherry in blossom.
TreeForm cherry(float height, float spread, int dabs, float dab);

/// A kind of flower: heads of five petals in two colours.
struct Flower {
    const char* name;
    uint32_t seed;
    glm::vec3 petals, others;
};
inline constexpr Flower poppies{"poppies", 11, {0.78f, 0.085f, 0.045f}, {0.85f, 0.78f, 0.62f}};
inline constexpr Flower cornflowers{"cornflowers", 12, {0.13f, 0.20f, 0.66f}, {0.62f, 0.42f, 0.72f}};
inline constexpr Flower buttercups{"buttercups", 13, {0.86f, 0.62f, 0.06f}, {0.88f, 0.84f, 0.74f}};

/// A patch of flowers about `radius` metres wide, on stems.
Mesh flowerPatch(const Flower& flower, int count, float radius);

/// What trees, flowers and tufts of grass wear: seen from both sides, without gloss.
Material dabs();

}  // namespace lodestir::generate
