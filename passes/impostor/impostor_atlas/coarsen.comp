// SPDX-License-Identifier: MIT
// A level of a mesh's views, side by side, from the finer one before it: means of four texels. Argument 3 is the level.
#version 460
#include "pass.glsl"
#include "made_texel.glsl"

void main() {
    if (skip()) return;
    Atlases made = atlases();
    AtlasRecord object = made.objects.at[bakedMesh()];
    uint level = argument(3), n = made.resolution >> level, view = uint(pixel().x) / n;
    uvec2 texel = uvec2(uint(pixel().x) % n, pixel().y);
    AtlasTexel mean = emptyAtlasTexel();
    for (uint i = 0u; i < 4u; ++i) addTexel(mean, atlasTexelAt(made, object, level - 1u, view, 2u * texel + uvec2(i & 1u, i >> 1)), 0.25);
    storeTexel(made, level, view, texel, mean);
}
