// SPDX-License-Identifier: MIT
// Of each tile: how much it needs paths, by its pixels and what it was last frame.
#version 460
#include "pass.glsl"
#include "tile.glsl"

shared vec4 sums[64];  // need, pixels that have to be traced, pixels, luminance
shared vec2 most[64];  // need, and of the tiles that the pixels were in last frame

// The largest around a pixel: one whose paths all missed is not done where a neighbour's didn't (Pharr 2018, Real-Time Rendering's Next Frontier).
float needAround(ivec2 p) {
    float need = 0;
    for (int y = -params.reach; y <= params.reach; ++y)
        for (int x = -params.reach; x <= params.reach; ++x) {
            ivec2 q = clamp(p + ivec2(x, y), ivec2(0), ivec2(frameSize()) - 1);
            need = max(need, needs(pixelIndex(q)).need);
        }
    return need;
}

void main() {
    if (warming()) return;
    vec4 sum = vec4(0);
    vec2 large = vec2(0);
    for (uint i = 0; i < 4; ++i) {
        uvec2 p = quadCorner() + inQuad(i);
        if (!inImage(p)) continue;
        float need = needAround(ivec2(p));
        PixelNeed own = needs(pixelIndex(ivec2(p)));
        sum += vec4(need, float(own.must), 1, own.luminance);
        large = max(large, vec2(need, carried(pixelIndex(ivec2(p))).need));
    }
    sums[gl_LocalInvocationIndex] = sum;
    most[gl_LocalInvocationIndex] = large;
    barrier();
    uvec2 local = gl_LocalInvocationID.xy, side = uvec2(tileSide() / 2);
    if (local % side != uvec2(0) || !inImage(quadCorner())) return;
    sum = vec4(0);
    large = vec2(0);
    for (uint y = local.y; y < local.y + side.y; ++y)
        for (uint x = local.x; x < local.x + side.x; ++x) {
            sum += sums[y * 8 + x];
            large = max(large, most[y * 8 + x]);
        }
    // Battlefield V takes the largest; Snowdrop average and largest, and of last frame what is left by then.
    float need = params.manner == manner_budget ? large.x : max(0.5 * (sum.x / sum.z + large.x), 0.8 * large.y);
    storeTiles(tileIndex(quadCorner()), TileNeed(need, sum.y, sum.z, sum.w));
}
