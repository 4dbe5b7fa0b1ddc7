// SPDX-License-Identifier: MIT
// If these fail, more or fewer paths are traced than were asked for, pixels are left out for ever, or the order of pixels is none.
// groups: 64
// passes: 2
#version 460
#include "base/test.glsl"
#include "rate/block.glsl"
layout(local_size_x = 64) in;

const uvec2 SIZES[4] = uvec2[](uvec2(64, 64), uvec2(45, 19), uvec2(7, 33), uvec2(61, 1));

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (testPush.pass == 1u) {
        // Each place of the order was taken once.
        for (uint k = 0u; k < 4u; ++k) EXPECT_EQ(testScratch[k * 4096u + id], id < SIZES[k].x * SIZES[k].y ? 1u : 0u);
        return;
    }
    // The mean over the random number is the share; steps never skip one.
    float share = (float(id) + 0.5) / 4096.0, mean = 0.0;
    for (uint coarsest = 2u; coarsest < SHARE_STEPS; ++coarsest) {
        mean = 0.0;
        uint least = SHARE_STEPS, most = 0u;
        for (uint i = 0u; i < 1024u; ++i) {
            uint step = roundedStep(share, coarsest, (float(i) + 0.5) / 1024.0);
            mean += SHARES[step] / 1024.0;
            least = min(least, step);
            most = max(most, step);
        }
        EXPECT_NEAR(mean, max(share, SHARES[coarsest]), 0.5 / 1024.0);
        EXPECT_TRUE(most <= coarsest && most - least <= 1u);
        uint enough = sufficientStep(share, coarsest);
        EXPECT_TRUE(SHARES[enough] >= share && (enough == coarsest || SHARES[enough + 1u] < share));
    }
    for (uint step = 0u; step < SHARE_STEPS; ++step) {
        EXPECT_EQ(roundedStep(SHARES[step], SHARE_STEPS - 1u, share), step);
        EXPECT_EQ(sufficientStep(SHARES[step], SHARE_STEPS - 1u), step);
    }
    // Every pixel has its turn, whatever the block.
    uvec2 block = uvec2(1u + (id & 3u), 1u + (id >> 2 & 3u));
    uint seen = 0u, count = block.x * block.y;
    for (uint turn = 0u; turn < count; ++turn) {
        uvec2 p = pixelOfTurn(block, turn + id * count);
        EXPECT_TRUE(all(lessThan(p, block)));
        seen |= 1u << p.y * 4u + p.x;
    }
    EXPECT_EQ(uint(bitCount(seen)), count);
    // Pixels of tiles one after the other: each tile has its part of the order, and each pixel its place in the tile.
    uvec2 p = uvec2(id & 15u, id >> 4 & 15u);
    if (id < 256u) EXPECT_TRUE(placeInTile(p) < 256u);
    if (id < 255u) EXPECT_TRUE(placeInTile(p) != placeInTile(uvec2(id + 1u & 15u, id + 1u >> 4)));
    for (uint k = 0u; k < 4u; ++k) {
        uvec2 size = SIZES[k];
        uvec2 pixel = uvec2(id % size.x, id / size.x), tile = pixel / 16u;
        if (pixel.y >= size.y) continue;
        uint before = 0u, own = placeInTile(pixel % 16u);
        for (uint y = 0u; y < 16u; ++y)
            for (uint x = 0u; x < 16u; ++x) {
                bool there = all(lessThan(16u * tile + uvec2(x, y), size));
                before += there && placeInTile(uvec2(x, y)) < own ? 1u : 0u;
            }
        atomicAdd(testScratch[k * 4096u + pixelsBefore(tile, size) + before], 1u);
    }
}
