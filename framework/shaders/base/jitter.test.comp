// SPDX-License-Identifier: MIT
// If these fail, images of one place inside the pixel per frame are no box filter's: neither over the frames of a run nor over runs.
// groups: 64
// passes: 2
#version 460
#include "base/jitter.glsl"
#include "base/test.glsl"
layout(local_size_x = 64) in;

const uint SIDE = 8u, CELLS = SIDE * SIDE, KINDS = 3u;
const uint COUNT = 64u * 64u;  // of places, one a thread
const uint FRAMES = 0u;        // of one run, from the first on
const uint LATE_FRAMES = 1u;   // of one run, around where 32 bits of frames end
const uint RUNS = 2u;          // of one frame

vec2 placeOf(uint kind, uint id) {
    if (kind == FRAMES) return frameJitter(id, 7u);
    if (kind == LATE_FRAMES) return frameJitter(0xfffff800u + id, 7u);
    return frameJitter(12u, id);
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (testPush.pass == 0u) {
        for (uint kind = 0u; kind < KINDS; ++kind) {
            vec2 place = placeOf(kind, id);
            EXPECT_TRUE(all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, vec2(1.0))));
            uvec2 cell = uvec2(place * float(SIDE));
            atomicAdd(testScratch[kind * CELLS + cell.y * SIDE + cell.x], 1u);
        }
        return;
    }
    if (id >= KINDS * CELLS) return;
    // Even from frame to frame: each cell has its share but for a few. Random from run to run: five standard deviations.
    float mean = float(COUNT) / float(CELLS), count = float(testScratch[id]);
    EXPECT_TRUE(abs(count - mean) <= (id / CELLS == RUNS ? 5.0 * sqrt(mean) : 4.0));
}
