// SPDX-License-Identifier: MIT
// Blocks of pixels of which one is traced: how large they are for a given share of traced pixels, and which pixel it is.

const uint SHARE_STEPS = 4u;
const float SHARES[SHARE_STEPS] = float[](1.0, 0.5, 0.25, 0.0625);  // 1x1, 1x2 or 2x1, 2x2, 4x4

/// The step of SHARES for a wanted share in [0, 1], at most `coarsest`: rounded up or down at random, so that the mean is the share that was wanted. (A tile
/// that always took the next one would always have too many paths or too few: It Just Works: Ray-Traced Reflections in Battlefield V.) u in [0, 1).
uint roundedStep(float share, uint coarsest, float u) {
    uint step = 0u;
    while (step < coarsest && SHARES[step + 1u] >= share) ++step;
    if (step == coarsest) return step;
    float finer = SHARES[step], coarser = SHARES[step + 1u];
    return u * (finer - coarser) < share - coarser ? step : step + 1u;
}

/// The coarsest step that has at least the wanted share.
uint sufficientStep(float share, uint coarsest) {
    uint step = 0u;
    while (step < coarsest && SHARES[step + 1u] >= share) ++step;
    return step;
}

/// The pixel of a block that is traced in turn `turn`: each of the block's once in as many turns as it has pixels. Those of a quad go across it first, of
/// larger blocks quad after quad likewise, so that neighbours in time are far apart. A block that the image's edge cuts goes row by row.
uvec2 pixelOfTurn(uvec2 block, uint turn) {
    const uvec2 across[4] = uvec2[](uvec2(0, 0), uvec2(1, 1), uvec2(1, 0), uvec2(0, 1));
    turn %= block.x * block.y;
    if (block == uvec2(4)) return 2u * across[turn & 3u] + across[turn >> 2];
    if (block == uvec2(2)) return across[turn];
    return uvec2(turn % block.x, turn / block.x);
}

// Where a pixel of a tile of 16x16 comes in the order that blocks of 4x2 are walked in by trace/driver.glsl: tiles of 8x8, in them blocks row by row.
uint placeInTile(uvec2 p) {
    uint inBlock = (p.x & 3u) | (p.y & 1u) << 2, block = (p.x >> 2 & 1u) | (p.y >> 1 & 3u) << 1;
    return ((p.x >> 3) | (p.y >> 3) << 1) * 64u + block * 8u + inBlock;
}

/// The pixels of the tiles of 16x16 before this one, where tiles come row by row and the image's edge cuts some.
uint pixelsBefore(uvec2 tile, uvec2 size) { return 16u * tile.y * size.x + 16u * tile.x * min(16u, size.y - 16u * tile.y); }
