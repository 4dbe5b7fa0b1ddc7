// SPDX-License-Identifier: MIT
// Furniture of the interior: table, chair, armchair, side table, lamps, picture frame. Pieces stand on y = 0 unless they say otherwise.
#pragma once

#include <cstdint>
#include <string>

#include <glm/glm.hpp>

#include "glb.h"

namespace lodestir::generate {

/// Materials of the interior, as indices; dyed and stained variants share their pictures.
struct Palette {
    int oak, walnut, birch;
    int wall, accent, ceiling, trim, floor;
    int upholstery, cushion, linen, rug;
    int paper, books, gilt;
    int blackMetal, brass, enamel, bulb, shade;
    int stoneware, clay, glaze, fruit;
    int leaf, stem, soil;
    int glass, grass;
};

/// A dining table with a `size` top (x, z), 0.74 m high.
Model diningTable(const Palette& palette, const glm::vec2& size);

/// A dining chair facing -z, seat 0.45 m high.
Model chair(const Palette& palette);

/// An upholstered armchair facing +z, 0.8 m wide.
Model armchair(const Palette& palette);

/// A round side table.
Model sideTable(const Palette& palette, float radius, float height);

/// A dome lamp hanging from (0, 0, 0) on `drop` metres of cord.
Model pendantLamp(const Palette& palette, float drop);

/// A standing lamp with a drum shade, 1.55 m tall.
Model floorLamp(const Palette& palette);

/// A framed picture of `size`, back to the wall at z = 0, facing +z, centred on the origin. The art's UVs span [0,1].
Model pictureFrame(const std::string& name, const Palette& palette, const glm::vec2& size, float mat, int frame, int art);

}  // namespace lodestir::generate
