// SPDX-License-Identifier: MIT
// The nearest instance of each pixel.
#version 460
#include "pass.glsl"
#include "cards.glsl"

void main() {
    if (skip()) return;
    scatterBlocks(uint(pixel().x), push.extent.x);
}
