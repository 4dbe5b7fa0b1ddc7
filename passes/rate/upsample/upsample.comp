// SPDX-License-Identifier: MIT
// Joint bilateral upsampling (Kopf et al. 2007): a mean over traced pixels, weighted by distance and by how alike their surfaces are.
#version 460
#include "pass.glsl"
#include "base/math.glsl"
#include "rate/walk.glsl"

float alikeness(ivec2 p, ivec2 q) {
    float a = depths(p), b = depths(q);
    if (a == 0 || b == 0) return float(a == b);  // sky
    return exp(-abs(a - b) / (params.tolerance * max(a, b))) * pow(max(dot(normalsRgba(p).xyz, normalsRgba(q).xyz), 0), params.sharpness);
}

void main() {
    if (skip()) return;
    ivec2 p = pixel();
    vec4 sum = vec4(0);
    for (int y = -params.radius; y <= params.radius; ++y)
        for (int x = -params.radius; x <= params.radius; ++x) {
            ivec2 q = p + ivec2(x, y);
            if (!isSkipped(p) || !inside(q) || isSkipped(q)) continue;
            sum += vec4(colorRgba(q).rgb, 1) * alikeness(p, q) * exp(-2.0 * float(x * x + y * y) / square(float(params.radius)));
        }
    vec3 nearest = colorRgba(standIn(p)).rgb;  // itself where it is traced
    storeColor(p, vec4(sum.w > 1e-6 ? sum.rgb / sum.w : nearest, 1));
}
