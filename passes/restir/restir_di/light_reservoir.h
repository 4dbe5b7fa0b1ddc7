// SPDX-License-Identifier: MIT
// A pixel's light point with its weight.
#ifndef LODESTIR_LIGHT_RESERVOIR_H
#define LODESTIR_LIGHT_RESERVOIR_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

struct LightReservoir {
    uint light;   // index in World.lights; of no meaning while W is 0
    uint texel;   // environment: EnvironmentPoint (light/environment.glsl)
    vec2 uv;      // triangle: barycentrics, environment: place inside the texel
    float W;      // unbiased contribution weight: stands for 1 / density, per area of a triangle, per steradian of the environment, 1 / chance of others
    float M;      // confidence
    float pHat;   // target in the pixel that holds it: luminance of what would arrive if nothing were in the way
    uint pad;
};

LODESTIR_SHARED_END
LODESTIR_SHARED(LightReservoir, "light_reservoir.h")
#endif
