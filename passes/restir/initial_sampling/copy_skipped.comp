// SPDX-License-Identifier: MIT
// Skipped pixels take the path of the pixel that stands for their block.
#version 460
#include "pass.glsl"

void main() {
    if (skip()) return;
    uint i = pixelIndex(pixel());
#if HAS_rates
    uint source = ratesPixels(i).source;
    if (source == i) return;
    storePathsReservoirs(i, pathsReservoirs(source));
    storePathsSamples(i, pathsSamples(source));
#endif
}
