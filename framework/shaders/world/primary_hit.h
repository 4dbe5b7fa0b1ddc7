// SPDX-License-Identifier: MIT
// What a pixel's camera ray hit, with the film and lens sample that made the ray: all that later passes need to find the point again.
#ifndef LODESTIR_PRIMARY_HIT_H
#define LODESTIR_PRIMARY_HIT_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

struct PrimaryHit {
    uint instance;
    uint primitive;     // World.primitives index, NONE: the ray left the scene
    vec2 barycentrics;  // of the second and third vertex
    vec2 film;          // place inside the pixel, [0,1)^2, y down: what a path keeps on its way to another pixel
    vec2 lens;          // [0,1]^2, see world/camera.glsl
};

LODESTIR_SHARED_END
LODESTIR_SHARED(PrimaryHit, "world/primary_hit.h")
#endif
