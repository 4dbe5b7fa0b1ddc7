// SPDX-License-Identifier: MIT
// Which light of which tile a vertex may choose (Lin et al. 2026, ReSTIR PT Enhanced, section 6.1). Pixels of a block share a tile, so that they read
// the same memory; another vertex or frame takes another tile.
#include "restir/light_number.glsl"

const uint TILE_STREAM = 0xffffffffu;    // of the numbers that tiles are drawn by
const uint CHOICE_STREAM = 0xfffffffeu; // of the tiles that blocks take
const uint BLOCK = 8u;                  // side of a block, pixels

/// The number of an entry of all tiles. Its stratum is its place in its tile.
uint tileNumber(uint entry, uint frame, uint run) {
    uint place = entry % TILE_LIGHTS;
    uvec2 seed = streamSeed(uvec2(place, entry / TILE_LIGHTS), frame, run, TILE_STREAM);
    return randomBits3(seed, 0u, RANDOM_LIGHT_CHOICE).x / TILE_LIGHTS * TILE_LIGHTS + place;
}

LightPoint lightOf(TileLight t) { return LightPoint(t.light, t.texel, t.uv); }

/// Where in its tile a vertex finds its candidates: at equal distances, from a start of the path's own, so that each place has the same chance.
struct LightDraw {
    uint tile, start, step;
};

/// For `candidates` of them.
LightDraw drawFromTile(uvec2 seed, uvec2 pixel, uint frame, uint run, uint vertex, uint candidates) {
    uint tile = randomBits3(streamSeed(pixel / BLOCK, frame, run, CHOICE_STREAM), vertex, RANDOM_LIGHT_CHOICE).x % LIGHT_TILES;
    return LightDraw(tile, randomBits3(seed, vertex, RANDOM_LIGHT_CHOICE).x, max(TILE_LIGHTS / candidates, 1u));
}

/// The entry of one of them.
uint tileEntry(LightDraw d, uint candidate) { return d.tile * TILE_LIGHTS + (d.start + candidate * d.step) % TILE_LIGHTS; }
