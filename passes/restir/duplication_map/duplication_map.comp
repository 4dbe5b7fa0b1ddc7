// SPDX-License-Identifier: MIT
// Copies of a path have its seed (Lin et al. 2026, ReSTIR PT Enhanced, section 5). A group shares the seeds of its pixels and of those around.
#version 460
#include "pass.glsl"
#include "restir/reservoir.glsl"

const int MOST_RADIUS = 16, MOST_SIDE = 8 + 2 * MOST_RADIUS;
const uvec2 NO_PATH = uvec2(0);

shared uvec2 tile[MOST_SIDE * MOST_SIDE];

uvec2 seedOf(ivec2 p) {
    if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, ivec2(frameSize())))) return NO_PATH;
    Reservoir r = pathsReservoirs(pixelIndex(p));
    return holdsPath(r) ? r.seed : NO_PATH;
}

void main() {
    if (warming()) return;
    // A frame of one row comes in groups of 64x1, and has nothing above and below.
    bool row = push.extent.y == 1u;
    ivec2 group = row ? ivec2(64, 1) : ivec2(8), halo = ivec2(params.radius, row ? 0 : params.radius), side = group + 2 * halo;
    ivec2 corner = ivec2(push.base) + ivec2(gl_WorkGroupID.xy) * group - halo;
    for (int i = int(gl_LocalInvocationIndex); i < side.x * side.y; i += 64) tile[i] = seedOf(corner + ivec2(i % side.x, i / side.x));
    barrier();
    if (skip()) return;

    ivec2 here = pixel() - corner;
    uvec2 own = tile[here.y * side.x + here.x];
    int copies = 0;
    if (own != NO_PATH) {
        for (int y = here.y - halo.y; y <= here.y + halo.y; ++y)
            for (int x = here.x - halo.x; x <= here.x + halo.x; ++x) copies += int(tile[y * side.x + x] == own);
        --copies;  // the pixel itself
    }
    int width = 2 * params.radius + 1;
    storeDuplication(pixel(), float(copies) / float(width * width - 1));
}
