// SPDX-License-Identifier: MIT
// The blocks of pixels by number, in turns (argument 0).
#version 460
#include "pass.glsl"
#include "impostor/atlas_instances.glsl"

void main() {
    if (skip()) return;
    numberBlocks(argument(0), uint(pixel().x));
}
