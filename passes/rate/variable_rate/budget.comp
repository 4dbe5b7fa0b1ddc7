// SPDX-License-Identifier: MIT
// One workgroup: the mean of the image, and how much of a tile is traced for its need so that all tiles together take the budget.
#version 460
#include "pass.glsl"
#include "share.glsl"

shared vec2 sums[64];

// Sum over the workgroup, in one order.
vec2 sumOf(vec2 own) {
    barrier();
    sums[gl_LocalInvocationIndex] = own;
    barrier();
    vec2 sum = vec2(0);
    for (uint i = 0; i < 64; ++i) sum += sums[i];
    return sum;
}

// Pixels that are traced in the mean, over the tiles of this invocation.
float traced(float balanceTried) {
    float sum = 0;
    for (uint i = gl_LocalInvocationIndex; i < tilesCount(); i += 64) {
        TileNeed t = tiles(i);
        sum += t.must + (t.pixels - t.must) * budgetShare(t.need, balanceTried);
    }
    return sum;
}

void main() {
    if (warming()) return;
    vec2 image = vec2(0);
    for (uint i = gl_LocalInvocationIndex; i < tilesCount(); i += 64) image += vec2(tiles(i).luminance, tiles(i).pixels);
    image = sumOf(image);
    float low = 0, high = 1 / LEAST_NEED;
    if (params.manner == manner_budget) {
        for (int step = 0; step < 20; ++step) {
            float middle = 0.5 * (low + high);
            if (sumOf(vec2(traced(middle), 0)).x < params.budget * image.y) low = middle;
            else high = middle;
        }
    }
    if (gl_LocalInvocationIndex != 0) return;
    storeFrameMean(0, image.x / image.y);
    storeBalance(0, low);
}
