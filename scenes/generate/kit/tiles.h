// SPDX-License-Identifier: MIT
// Tiles of glazed clay and polished stone with grout between them, each a little tilted and of a tone of its own, so that what they reflect
// breaks from tile to tile.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "mesh.h"
#include "picture.h"

namespace lodestir::generate {

/// How a surface is tiled; metres.
struct Tiling {
    glm::vec2 tile{0.1f};
    glm::ivec2 count{4};        ///< tiles of the picture, which repeats after them
    bool bond = false;          ///< every other row is shifted by half a tile; count.y is even
    glm::vec3 color{0.8f};      ///< linear reflectance of the body under the glaze
    glm::vec3 second{0.8f};     ///< of every other tile, as on a chessboard; count is even both ways
    glm::vec3 grout{0.45f};     ///< of the joints
    float joint = 0.002f;       ///< width of the joints
    float edge = 0.004f;        ///< width of the rounded edge
    float roughness = 0.08f;
    float tone = 0.05f;         ///< how far tiles differ in tone
    float tilt = 0.003f;        ///< how far they lean, radians
    float wave = 0.0003f;       ///< unevenness of the glaze
    float veins = 0;            ///< strength of the veins of marble

    glm::vec2 size() const { return tile * glm::vec2(count); }
};

Textures paintTiles(const Tiling& tiling, uint32_t seed, int width);

/// `mesh` with UVs from its positions, straight through each face, so that a picture of `size` runs on from piece to piece. v runs down walls.
Mesh facing(Mesh mesh, const glm::vec2& size);

}  // namespace lodestir::generate
