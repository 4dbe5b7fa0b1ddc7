// SPDX-License-Identifier: MIT
// Enters each path of last frame into the list of the pixel it lands in.
#version 460
#include "pass.glsl"

void main() {
    if (skip()) return;
    uint i = pixelIndex(pixel());
    Landing landing = landings(i);
    if (landing.target != 0xffffffffu) storeLists(starts(landing.target) + landing.order, i);
}
