// SPDX-License-Identifier: MIT
// What of an instance's impostor is drawn in a frame.
#ifndef LODESTIR_DRAWN_H
#define LODESTIR_DRAWN_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

const uint NOT_DRAWN = 15u;  // as a level: as geometry, or not at all

// Tiles of 8x8 texels (4x4 where a level has no more) are numbered through the frame: instance after instance, in each first the tiles of the level, then those
// of the level that it fades out of, in each view after view that is kept.
struct DrawnLevel {
    uint level;  // NOT_DRAWN: none
    uint views;  // a bit for each that is kept
};

struct Drawn {
    DrawnLevel now, before;  // before: what fades out
    float share;             // of the pixels that `now` has by now
};

// The nearest texel of a pixel: a number of 64 bits whose order is that of nearness.
struct SplatKey {
    uint low;   // which texel
    uint high;  // how near, and how well it was seen
};

LODESTIR_SHARED_END
LODESTIR_SHARED(Drawn, "drawn.h")
LODESTIR_SHARED(SplatKey, "drawn.h")
#endif
