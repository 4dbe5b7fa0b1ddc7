// SPDX-License-Identifier: MIT
// Colours for errors; the same as colorMap() of framework/image/color_map.cpp, where the curve is explained.

float decodeSrgb(float c) { return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4); }

// Linear colour of a value from 0 (black) to `top` (pale yellow); green where it is no number.
vec3 colorMap(float value, float top) {
    if (isnan(value)) return vec3(0, 1, 0);
    float t = clamp(top > 0 ? value / top : float(value > 0), 0.0, 1.0);
    vec3 c = vec3(5.234, -5.416, -12.442);
    c = c * t + vec3(-11.408, 11.196, 31.858);
    c = c * t + vec3(6.170, -6.577, -23.746);
    c = c * t + vec3(-0.073, 1.587, 2.842);
    c = c * t + vec3(1.083, 0.182, 2.247);
    c = clamp(c * t + vec3(-0.021, 0.011, -0.004), 0, 1);
    return vec3(decodeSrgb(c.r), decodeSrgb(c.g), decodeSrgb(c.b));
}
