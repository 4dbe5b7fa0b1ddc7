// SPDX-License-Identifier: MIT
#version 460
#include "pass.glsl"
#include "base/tone_curve.glsl"

void main() {
    if (skip()) return;
    ivec2 p = pixel();
    vec3 c = max(colorRgba(p).rgb, 0) * exp2(params.exposure + uintBitsToFloat(argument(0)));
    if (params.curve == curve_neutral) c = toneNeutral(c);
    else if (params.curve == curve_aces) c = toneAces(c);
    else if (params.curve == curve_reinhard) c = toneReinhard(c);
    storeDisplay(p, vec4(clamp(c, 0, 1), 1));
}
