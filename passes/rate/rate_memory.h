// SPDX-License-Identifier: MIT
// What a pixel remembers of earlier frames to choose its rate by; rate/rate_memory.glsl reads and writes the packed word.
#ifndef LODESTIR_RATE_MEMORY_H
#define LODESTIR_RATE_MEMORY_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

struct RateMemory {
    float mean;        // of the luminance over frames
    float meanSquare;  // of its square
    float need;        // of its tile, last frame
    uint packed;       // 8 bits each: rates of the last four frames, frames since the pixel was traced, frames that the moments are of
};

LODESTIR_SHARED_END
LODESTIR_SHARED(RateMemory, "rate/rate_memory.h")
#endif
