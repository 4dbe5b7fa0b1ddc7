// SPDX-License-Identifier: MIT
#version 460
#include "pass.glsl"

void main() {
    if (skip()) return;
    ivec2 p = pixel(), low = max(p - params.radius, 0), high = min(p + params.radius, imageSize() - 1);
    bool isNear = false;
    for (int y = low.y; y <= high.y && !isNear; ++y)
        for (int x = low.x; x <= high.x && !isNear; ++x) isNear = imageRgba(ivec2(x, y)).rgb != vec3(0.0);
    storeMask(p, isNear ? 1.0 : 0.0);
}
