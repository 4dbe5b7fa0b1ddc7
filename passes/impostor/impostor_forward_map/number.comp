// SPDX-License-Identifier: MIT
// The items of all instances by number, in turns (argument 0).
#version 460
#include "pass.glsl"
#include "impostor/instance_items.glsl"

void main() {
    if (skip()) return;
    numberItems(argument(0), uint(pixel().x));
}
