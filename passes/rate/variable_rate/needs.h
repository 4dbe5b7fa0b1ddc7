// SPDX-License-Identifier: MIT
// What the shaders of variable_rate tell each other: how much pixels and tiles need paths of their own.
#ifndef LODESTIR_NEEDS_H
#define LODESTIR_NEEDS_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

struct PixelNeed {
    float need;       // 0 to 1
    uint must;        // 1: traced whatever the rate
    float luminance;  // that last frame's image had here
};

struct TileNeed {
    float need;       // 0 to 1
    float must;       // pixels that have to be traced
    float pixels;     // of the image that it holds
    float luminance;  // their sum
};

const uint TILE_SIDES[3] = {2u, 8u, 16u};  // by the parameter `tile`, pixels

LODESTIR_SHARED_END
LODESTIR_SHARED(PixelNeed, "rate/variable_rate/needs.h")
LODESTIR_SHARED(TileNeed, "rate/variable_rate/needs.h")
#endif
