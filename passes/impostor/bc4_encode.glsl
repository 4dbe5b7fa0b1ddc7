// SPDX-License-Identifier: MIT
// The inverse of bc4Decode: end points by least squares and by trying their neighbours.
#include "impostor/bc4.glsl"

const float BC4_REFUSED = 1e30;  // error of end points that may not be taken

struct Bc4Trial {
    uvec2 block;
    float error;    // sum of squares over the texels that count
    vec3 squares;   // sums of a^2, a (1 - a) and (1 - a)^2, where a is the share of the first end point in a texel's value
    vec2 products;  // of the value times a, and times 1 - a
};

uint bc4Nearest(uvec2 ends, float value, bool keepsZero) {
    vec2 e = vec2(ends) / 255.0;
    bool eight = ends.x > ends.y;
    float steps = eight ? 7.0 : 5.0, range = e.y - e.x;
    float k = range == 0.0 ? 0.0 : clamp(floor((value - e.x) / range * steps + 0.5), 0.0, steps);
    uint code = k == 0.0 ? 0u : k == steps ? 1u : uint(k) + 1u;
    if (eight) return code;
    float off = abs(bc4Value(ends, code) - value);
    if (value < off && (value == 0.0 || !keepsZero)) return 6u;
    return 1.0 - value < off ? 7u : code;
}

Bc4Trial bc4Try(float values[16], uint counted, bool keepsZero, uvec2 ends) {
    Bc4Trial trial = Bc4Trial(uvec2(0u), 0.0, vec3(0.0), vec2(0.0));
    uvec2 codes = uvec2(0u);
    float steps = ends.x > ends.y ? 7.0 : 5.0;
    for (uint i = 0u; i < 16u; ++i) {
        if ((counted >> i & 1u) == 0u) continue;
        uint code = bc4Nearest(ends, values[i], keepsZero);
        codes[i >> 3] |= code << (3u * (i & 7u));
        float made = bc4Value(ends, code), off = made - values[i];
        trial.error += keepsZero && (made == 0.0) != (values[i] == 0.0) ? BC4_REFUSED : off * off;
        if (ends.x <= ends.y && code >= 6u) continue;
        float b = code == 0u ? 0.0 : code == 1u ? 1.0 : (float(code) - 1.0) / steps, a = 1.0 - b;
        trial.squares += vec3(a * a, a * b, b * b);
        trial.products += values[i] * vec2(a, b);
    }
    trial.block = uvec2(ends.x | ends.y << 8 | codes.x << 16, codes.x >> 16 | codes.y << 8);
    return trial;
}

uvec2 bc4Ends(uvec2 block) { return uvec2(block.x & 0xffu, block.x >> 8 & 0xffu); }

/// End points that fit the codes of a trial best.
uvec2 bc4Fitted(Bc4Trial trial) {
    float area = trial.squares.x * trial.squares.z - trial.squares.y * trial.squares.y;
    if (area < 1e-6) return bc4Ends(trial.block);
    vec2 fitted = vec2(trial.squares.z * trial.products.x - trial.squares.y * trial.products.y,
                       trial.squares.x * trial.products.y - trial.squares.y * trial.products.x) / area;
    return uvec2(clamp(fitted, 0.0, 1.0) * 255.0 + 0.5);
}

void bc4Improve(inout Bc4Trial best, float values[16], uint counted, bool keepsZero, uvec2 ends) {
    if (any(greaterThan(ends, uvec2(255u)))) return;
    Bc4Trial trial = bc4Try(values, counted, keepsZero, ends);
    if (trial.error < best.error) best = trial;
}

/// `counted`: a bit for each texel whose value matters. `keepsZero`: what is 0 stays 0 and nothing else becomes it; other values are at least 1/255.
uvec2 bc4Encode(float values[16], uint counted, bool keepsZero) {
    vec4 ranges = vec4(1.0, 0.0, 1.0, 0.0);  // of all values, and of those that are neither 0 nor 1
    for (uint i = 0u; i < 16u; ++i) {
        if ((counted >> i & 1u) == 0u) continue;
        float v = values[i];
        ranges.xy = vec2(min(ranges.x, v), max(ranges.y, v));
        if (v > 0.0 && v < 1.0) ranges.zw = vec2(min(ranges.z, v), max(ranges.w, v));
    }
    Bc4Trial best = Bc4Trial(uvec2(0u), counted == 0u ? 0.0 : 2.0 * BC4_REFUSED, vec3(0.0), vec2(0.0));
    for (uint trial = 0u; trial < 24u && best.error > 0.0; ++trial) {
        // First the ranges themselves, with 8 values and with 6; then what fits the better one's codes; then the end points around the best.
        uvec2 ends = bc4Ends(best.block);
        if (trial == 0u) ends = uvec2(ceil(ranges.y * 255.0 - 1e-3), floor(ranges.x * 255.0 + 1e-3));
        else if (trial == 1u) ends = ranges.z > ranges.w ? uvec2(0u) : uvec2(floor(ranges.z * 255.0 + 1e-3), ceil(ranges.w * 255.0 - 1e-3));
        else if (trial < 4u) ends = bc4Fitted(best);
        else ends += uvec2(ivec2(trial % 3u, trial / 3u % 3u) - 1);
        bc4Improve(best, values, counted, keepsZero, ends);
    }
    return best.block;
}
