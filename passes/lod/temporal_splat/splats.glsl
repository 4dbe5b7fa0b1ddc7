// SPDX-License-Identifier: MIT
// How often each path of last frame is splatted, and where its splats are kept. After pass.glsl.
#include "lod/partitions.glsl"
#include "world/scene_facts.glsl"

/// Once, unless the shutter is open and the time is the path's.
uint splatsOfPath() { return MOTION_BLUR != 0 && rules().pixelCamera == 0 ? uint(params.partitions) : 1; }

/// The splats of pixel `i` lie side by side.
uint splatOf(uint i, uint part) { return i * splatsOfPath() + part; }

ivec2 pixelOfSplat(uint splat) {
    uint i = splat / splatsOfPath();
    return ivec2(i % frameSize().x, i / frameSize().x);
}
