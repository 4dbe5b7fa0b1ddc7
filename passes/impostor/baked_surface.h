// SPDX-License-Identifier: MIT
// What the pixels of a frame show of atlases before light falls on it.
#ifndef LODESTIR_BAKED_SURFACE_H
#define LODESTIR_BAKED_SURFACE_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

// What an atlas of colours knows of a pixel: materials are evaluated, as baked.
struct BakedSurface {
    uint instance;  // NONE: the pixel shows none
    float depth;    // along the camera's forward direction, scene units
    uint normal;    // unit, world space, octahedral (packNormal)
    float alpha;    // share of the pixel that the object covers
    uvec2 color;    // base colour and perceptual roughness (packColor)
    uvec2 more;     // emission and metallic (packColor)
};

LODESTIR_SHARED_END
LODESTIR_SHARED(BakedSurface, "impostor/baked_surface.h")
#endif
