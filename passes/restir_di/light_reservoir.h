// SPDX-License-Identifier: MIT
// A pixel's light point with its weight.
#ifndef LODESTIR_LIGHT_RESERVOIR_H
#define LODESTIR_LIGHT_RESERVOIR_H
#ifdef __cplusplus
#include <framework/shaders/base/shared.h>
#else
#include "base/shared.h"
#endif

LODESTIR_SHARED_BEGIN

struct LightReservoir {
    uint light;   // index in World.lights; of no meaning while W is 0
    vec2 uv;      // triangle: barycentrics, environment: map coordinates
    float W;      // unbiased contribution weight: stands for 1 / density, per area of a triangle, per steradian of the environment
    float M;      // confidence
    float pHat;   // target in the pixel that holds it: luminance of what would arrive if nothing were in the way
    uvec2 pad;
};

LODESTIR_SHARED_END
LODESTIR_SHARED(LightReservoir, "light_reservoir.h")
#endif
