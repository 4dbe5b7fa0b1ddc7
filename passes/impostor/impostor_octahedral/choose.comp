// SPDX-License-Identifier: MIT
// Where each instance is drawn.
#version 460
#include "pass.glsl"
#include "impostor/atlas_instances.glsl"

void main() {
    if (skip()) return;
    chooseInstance(uint(pixel().x));
}
