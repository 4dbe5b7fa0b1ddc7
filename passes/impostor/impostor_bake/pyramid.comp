// SPDX-License-Identifier: MIT
// A level of a mesh's views, side by side, from the finer one before it.
#version 460
#include "pass.glsl"
#include "impostor/reduce.glsl"
#include "base/random.glsl"
#include "store_texel.glsl"

void main() {
    if (skip()) return;
    BakeJob work = job();
    uint level = argument(2), n = levelResolution(work.texels, level), view = uint(pixel().x) / n;
    uvec2 texel = uvec2(uint(pixel().x) % n, pixel().y);
    ImpostorTexel children[4];
    for (uint i = 0u; i < 4u; ++i) children[i] = texelAt(work.texels, work.mesh, level - 1u, view, 2u * texel + uvec2(i & 1u, i >> 1));
    storeTexel(work, level, view, texel, reduceTexels(children, 2u * n, pcg4d(uvec4(texel, view, level)).x), NONE);
}
