// SPDX-License-Identifier: MIT
// Copies materials from the one that argument 0 says, changed where argument 1 says so.
#version 460
#include "pass.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer MadeMaterials { MaterialRecord at[]; };

void main() {
    if (skip()) return;
    uint i = argument(0) + uint(pixel().x);
    MaterialRecord m = world().materials.at[i];
    if (argument(1) != 0u) {
        m.baseColor.rgb *= vec3(params.red, params.green, params.blue);
        m.emission *= params.emission;
        if (params.roughness >= 0.0) m.roughness = params.roughness;
        if (params.metallic >= 0.0) m.metallic = params.metallic;
    }
    MadeMaterials(uint64_t(madeWorld().materials)).at[i] = m;
}
