// SPDX-License-Identifier: MIT
// Copies lights from the one that argument 1 says, or texels of the environment, changed where argument 0 says so.
#version 460
#include "pass.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer MadeLights { LightRecord at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer MadeEnvironment { EnvironmentTexel at[]; };

const uint SCALES = 1u, SCALES_ENVIRONMENT = 2u;  // of argument 0; 0: copies

void main() {
    if (skip()) return;
    uint i = argument(1) + uint(pixel().x);
    if (argument(0) == SCALES_ENVIRONMENT) {
        EnvironmentTexel texel = world().environment.at[i];
        texel.radiance *= params.environment;
        MadeEnvironment(uint64_t(madeWorld().environment)).at[i] = texel;
        return;
    }
    LightRecord light = world().lights.at[i];
    if (argument(0) == SCALES) light.intensity *= params.intensity;
    MadeLights(uint64_t(madeWorld().lights)).at[i] = light;
}
