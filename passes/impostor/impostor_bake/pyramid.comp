// SPDX-License-Identifier: MIT
// A level of a mesh's views, side by side, from the finer one before it.
#version 460
#include "pass.glsl"
#include "impostor/reduce.glsl"
#include "store_texel.glsl"

void main() {
    if (skip()) return;
    Impostors made = impostors();
    uint level = argument(3), n = levelResolution(made, level), view = uint(pixel().x) / n;
    uvec2 texel = uvec2(uint(pixel().x) % n, pixel().y);
    ImpostorTexel children[4];
    for (uint i = 0u; i < 4u; ++i) children[i] = texelAt(made, bakedMesh(), level - 1u, view, 2u * texel + uvec2(i & 1u, i >> 1));
    storeTexel(made, level, view, texel, reduceTexels(children, 2u * n));
}
