// SPDX-License-Identifier: MIT
// Enters each path of last frame, as often as it is splatted, into the list of the pixel it lands in.
#version 460
#include "pass.glsl"
#include "splats.glsl"

void main() {
    if (skip()) return;
    for (uint i = 0; i < splatsOfPath(); ++i) {
        uint splat = splatOf(pixelIndex(pixel()), i);
        uint target = landings(splat).target;
        if (target != NONE) storeLists(addEnds(target, 1), splat);
    }
}
