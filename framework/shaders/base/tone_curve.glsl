// SPDX-License-Identifier: MIT
// Curves that bring scene-linear colour (>= 0) towards [0, 1].
#include "base/math.glsl"

// Khronos PBR Neutral tone mapper (Khronos Group 2024, "PBR Neutral Tone Mapper" specification): identity for base colours under
// normal light, highlights compressed from 0.8 and pulled towards white.
vec3 toneNeutral(vec3 c) {
    const float start = 0.8 - 0.04, desaturation = 0.15;
    float low = min(c.r, min(c.g, c.b));
    c -= low < 0.08 ? low - 6.25 * low * low : 0.04;
    float peak = max(c.r, max(c.g, c.b));
    if (peak < start) return c;
    float d = 1 - start;
    float compressed = 1 - d * d / (peak + d - start);
    float white = 1 - 1 / (desaturation * (peak - compressed) + 1);
    return mix(c * (compressed / peak), vec3(compressed), white);
}

// Narkowicz 2016, "ACES Filmic Tone Mapping Curve": a rational fit.
vec3 toneAces(vec3 c) { return c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14); }

// Reinhard et al. 2002, eq. 3, on luminance.
vec3 toneReinhard(vec3 c) { return c / (1 + luminance(c)); }
