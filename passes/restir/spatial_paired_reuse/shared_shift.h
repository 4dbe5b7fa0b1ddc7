// SPDX-License-Identifier: MIT
// What a shift between partners makes, for both of them. With the path that was shifted it gives all of the shifted one: within a frame a shift changes
// nothing else (44 bytes instead of 128).
#ifndef LODESTIR_SHARED_SHIFT_H
#define LODESTIR_SHARED_SHIFT_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

struct SharedShift {
    vec3 F;          // of the shifted path: Reservoir.F
    float G;         // Reservoir.G
    float jacobian;  // |dT/dx|; 0: the shift failed, SHIFT_NO_PARTNER: there is nobody to shift a path of
};

/// Where the shifted path begins, which only the one asks for who keeps it.
struct SharedFirstHit {
    uint instance;
    uint primitive;
    vec2 barycentrics;
    vec2 uv;  // SampleHit.uv
};

const float SHIFT_NO_PARTNER = -1.0f;

LODESTIR_SHARED_END
LODESTIR_SHARED(SharedShift, "restir/spatial_paired_reuse/shared_shift.h")
LODESTIR_SHARED(SharedFirstHit, "restir/spatial_paired_reuse/shared_shift.h")
#endif
