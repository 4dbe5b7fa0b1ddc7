// SPDX-License-Identifier: MIT
// What the pixels of a frame show of impostors before light falls on it: what passes that draw impostors make, hole_fill repairs, and reshade shades.
#ifndef LODESTIR_SURFEL_H
#define LODESTIR_SURFEL_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

// Among the flags of Surfel.measures, beside TEXEL_*.
const uint SURFEL_COUNTS = 8u;  // its materials are counts
const uint SURFEL_FADES = 16u;  // pixels around it may show the geometry instead: they are no holes

// A texel of an impostor where it landed: materials are named, not evaluated, so that they may change at any time.
struct Surfel {
    uint instance;   // NONE: the pixel shows none
    float depth;     // along the camera's forward direction, scene units
    uint normal;     // unit, world space, octahedral (packNormal): the mean's direction
    uint measures;   // length of the mean normal, density and flags, as in the third word of a texel's shape (impostor/texel.glsl)
    uint uv;         // of set 0 (packUv)
    uint materials;  // index in World.materials, or with SURFEL_COUNTS among the flags the palette's counts
    float alpha;     // share of the texel that the object covers
    uint texel;      // index in the arrays of its mesh's ImpostorRecord
};

LODESTIR_SHARED_END
LODESTIR_SHARED(Surfel, "impostor/surfel.h")
#endif
