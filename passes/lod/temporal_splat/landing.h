// SPDX-License-Identifier: MIT
// Where a splat of last frame's path of a pixel lands in this frame, and what this frame's path of a pixel would have been in the last.
#ifndef LODESTIR_LANDING_H
#define LODESTIR_LANDING_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

struct Landing {
    uint target;       // pixel it lands in, 0xffffffff: none
    float jacobian;    // of the whole shift
    float pHat;        // target of the path in last frame
    float confidence;  // of the pixel it comes from, capped
};

// pHatFrom of this frame's path by each technique that could have made it from last frame, times the confidence of the pixel that would have.
struct Origins {
    float scattered;
    float gathered;
    float kept;  // 1: what the pixel's centre sees was there last frame, on the level shown then; 0: it has no history to be splatted
};

LODESTIR_SHARED_END
LODESTIR_SHARED(Landing, "landing.h")
LODESTIR_SHARED(Origins, "landing.h")
#endif
