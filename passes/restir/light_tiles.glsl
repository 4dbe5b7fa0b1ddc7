// SPDX-License-Identifier: MIT
// Which light of which tile a vertex may choose (Lin et al. 2026, ReSTIR PT Enhanced, section 6.1). Pixels of a block share a tile, so that they read
// the same memory; another vertex or frame takes another tile.
#include "restir/light_number.glsl"
#include "restir/light_tiles.h"

const uint TILE_STREAM = 0xffffffffu;   // of the numbers that tiles are drawn by
const uint CHOICE_STREAM = 0xfffffffeu; // of the tiles that blocks take
const uint BLOCK = 8u;                  // side of a block, pixels

/// The number of an entry of all tiles. Its stratum is its place in its tile.
uint tileNumber(uint entry, uint frame, uint run) {
    uint place = entry % TILE_LIGHTS;
    uvec2 seed = streamSeed(uvec2(place, entry / TILE_LIGHTS), frame, run, TILE_STREAM);
    return (randomBits3(seed, 0u, RANDOM_LIGHT_CHOICE).x & ~(LIGHT_STRATA - 1u)) | place;
}

LightPoint lightOf(TileLight t) { return LightPoint(t.light, t.texel, t.uv); }

/// The entry of candidate i of n: places in the tile at equal distances, from a start of the path's own, so that each place has the same chance.
uint tileEntry(uvec2 seed, uvec2 pixel, uint frame, uint run, uint vertex, uint i, uint n) {
    uint tile = randomBits3(streamSeed(pixel / BLOCK, frame, run, CHOICE_STREAM), vertex, RANDOM_LIGHT_CHOICE).x % LIGHT_TILES;
    uint start = randomBits3(seed, vertex, RANDOM_LIGHT_CHOICE).x;
    return tile * TILE_LIGHTS + (start + i * max(TILE_LIGHTS / n, 1u)) % TILE_LIGHTS;
}
