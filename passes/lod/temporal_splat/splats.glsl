// SPDX-License-Identifier: MIT
// How often each path of last frame is splatted, and where its splats are kept. After pass.glsl.
#include "lod/partitions.glsl"

/// 0: paths are reprojected alone.
uint splatsOfPath() { return argument(0); }

/// The splats of pixel `i` lie side by side.
uint splatOf(uint i, uint part) { return i * splatsOfPath() + part; }

ivec2 pixelOfSplat(uint splat) {
    uint i = splat / splatsOfPath();
    return ivec2(i % frameSize().x, i / frameSize().x);
}
