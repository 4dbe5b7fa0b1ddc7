// SPDX-License-Identifier: MIT
// If these fail, lights of tiles don't have the chances that MIS weights count on, or a path doesn't find the light again that its vertex chose.
// groups: 64
// passes: 2
#version 460
#include "base/test.glsl"
#include "restir/light_tiles.glsl"
layout(local_size_x = 64) in;

const uint FRAME = 3u, RUN = 11u, VERTEX = 2u, COUNT = 64u * 64u;

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (testPush.pass == 0u) {
        // Each place of a tile is a stratum of the table, whatever tile and frame.
        uint entry = id * 31u % (LIGHT_TILES * TILE_LIGHTS), number = tileNumber(entry, FRAME, RUN);
        EXPECT_EQ(lightChoice(number).x >> 22, entry % TILE_LIGHTS);
        EXPECT_TRUE(number != tileNumber(entry, FRAME + 1u, RUN));
        // So is each number that a vertex draws: counted by 64ths.
        uint own = lightNumber(uvec2(id, 7u), VERTEX, 0u);
        EXPECT_TRUE(own != lightNumber(uvec2(id, 7u), VERTEX, 1u));
        atomicAdd(testScratch[lightChoice(own).x >> 26], 1u);
        // Candidates are of one tile and all different, wherever they start; paths start anywhere.
        for (uint n = 1u; n <= 256u; n *= 4u) {
            LightDraw d = drawFromTile(uvec2(id, 9u), uvec2(id % 8u, 4u), FRAME, RUN, VERTEX, n);
            uint first = tileEntry(d, 0u), last = tileEntry(d, n - 1u);
            EXPECT_EQ(first / TILE_LIGHTS, last / TILE_LIGHTS);
            EXPECT_EQ(last % TILE_LIGHTS, (first + TILE_LIGHTS / n * (n - 1u)) % TILE_LIGHTS);
            EXPECT_EQ(d.tile, drawFromTile(uvec2(0u), uvec2(0u), FRAME, RUN, VERTEX, n).tile);  // the block's, whatever pixel of it
            if (n == 1u) atomicAdd(testScratch[64u + first % TILE_LIGHTS / 16u], 1u);
        }
        return;
    }
    if (id >= 128u) return;
    float mean = float(COUNT) / 64.0;
    EXPECT_NEAR(float(testScratch[id]), mean, 5.0 * sqrt(mean));
}
