// SPDX-License-Identifier: MIT
#version 460
#include "pass.glsl"
#include "color_map.glsl"

// Keeps relative errors finite where the reference is black.
const float epsilon = 0.01;

float mean(vec3 c) { return (c.r + c.g + c.b) / 3; }

float errorOf(vec3 x, vec3 r) {
    vec3 difference = abs(x - r), scaled = params.exposure * difference;
    if (params.metric == metric_mse) return mean(difference * difference);
    if (params.metric == metric_mae) return mean(difference);
    if (params.metric == metric_mape) return 100 * mean(scaled / (params.exposure * abs(r) + epsilon));
    if (params.metric == metric_smape) return mean(scaled / (params.exposure * (abs(x) + abs(r)) + epsilon));
    float level = params.exposure * mean(r);
    return mean(scaled * scaled) / (level * level + epsilon);
}

void main() {
    if (skip()) return;
    ivec2 p = pixel();
    float e = errorOf(testRgba(p).rgb, referenceRgba(p).rgb);
    storeError(p, e);
    storeColors(p, vec4(colorMap(e, params.top), 1));
}
