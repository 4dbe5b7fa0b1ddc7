// SPDX-License-Identifier: MIT
// Gives each pixel room for the splats that land in it: a list ends where it begins until it is filled. The order of the lists doesn't matter.
#version 460
#include "pass.glsl"

void main() {
    if (skip()) return;
    uint i = pixelIndex(pixel()), count = counts(i);
    storeEnds(i, count > 0 ? addCursor(0, count) : 0);
}
