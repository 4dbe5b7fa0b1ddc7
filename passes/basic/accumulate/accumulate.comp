// SPDX-License-Identifier: MIT
#version 460
#include "pass.glsl"

void main() {
    if (skip()) return;
    ivec2 p = pixel();
    vec4 total = sum(p) + vec4(colorRgba(p).rgb, 1);
    storeSum(p, total);
    storeMean(p, vec4(total.rgb / total.w, 1));
}
