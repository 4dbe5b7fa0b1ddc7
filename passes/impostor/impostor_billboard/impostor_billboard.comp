// SPDX-License-Identifier: MIT
// What the nearest instance of each pixel shows.
#version 460
#include "pass.glsl"
#include "cards.glsl"

void main() {
    if (skip()) return;
    writeSurface(pixel());
}
