// SPDX-License-Identifier: MIT
// What of an instance's atlas is drawn in a frame, and which instance is nearest in a pixel.
#ifndef LODESTIR_ATLAS_INSTANCE_H
#define LODESTIR_ATLAS_INSTANCE_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

// Blocks of 8x8 pixels are numbered through the frame: instance after instance, in each row after row of the rectangle that it may be seen in.
struct AtlasInstance {
    uint corner;  // the first block's x, and its y (bits 16-31), in blocks
    uint shape;   // blocks across, and the level that is read (bits 16-31)
};

// A number of 64 bits whose order is that of nearness.
struct NearKey {
    uint instance;
    uint depth;  // along the camera's forward direction: bits of a positive float, which have its order
};

LODESTIR_SHARED_END
LODESTIR_SHARED(AtlasInstance, "impostor/atlas_instance.h")
LODESTIR_SHARED(NearKey, "impostor/atlas_instance.h")
#endif
