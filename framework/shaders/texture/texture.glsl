// SPDX-License-Identifier: MIT
// Textures read from memory: wrap modes, sRGB, bilinear and trilinear filters, the same bits on every device.
#include "world/world.h"

/// sRGB decoding (IEC 61966-2-1). On [0.04045, 1] a polynomial stands for the power 2.4, right to 2e-4 of the value (a tenth of a step of
/// 8 bits at most), in an eighth of the time of pow.
vec3 decodeSrgb(vec3 c) {
    vec3 high = -0.11208521 * c + 0.38656649;
    high = high * c - 0.60048726;
    high = high * c + 0.796687;
    high = high * c + 0.49352699;
    high = high * c + 0.034841654;
    high = high * c + 0.00086365706;
    return mix(c * (1.0 / 12.92), high, greaterThan(c, vec3(0.04045)));
}

vec4 decodeTexel(uint bits, bool srgb) {
    vec4 c = vec4(uvec4(bits, bits >> 8, bits >> 16, bits >> 24) & 255u) * (1.0 / 255.0);
    return srgb ? vec4(decodeSrgb(c.rgb), c.a) : c;
}

/// Folds a coordinate into [0, 1]: clamped, mirrored or repeated.
float wrapCoordinate(float u, bool clamped, bool mirrored) {
    if (clamped) return clamp(u, 0.0, 1.0);
    if (mirrored) return 1.0 - abs(u - 2.0 * floor(0.5 * u) - 1.0);
    return u - floor(u);
}

/// Texels i.x, i.y around the folded coordinate u of a row of `size` texels (centres at half-integers) and the weight of i.y. Both
/// indices are valid whatever u is, NaN too.
ivec2 texelPair(float u, int size, bool repeated, bool nearest, out float weight) {
    float x = u * float(size) - (nearest ? 0.0 : 0.5);
    float low = floor(x);
    weight = nearest ? 0.0 : x - low;
    ivec2 i = ivec2(int(low)) + ivec2(0, 1);
    if (repeated) {
        i.x = i.x < 0 ? size - 1 : i.x;
        i.y = i.y >= size ? 0 : i.y;
    }
    return clamp(i, 0, size - 1);
}

/// Linear colour of a texture (not NONE) at uv. `lod` 0 reads the finest level, between whole numbers two levels are blended.
vec4 sampleTexture(World w, uint id, vec2 uv, float lod) {
    TextureRecord t = w.textures.at[id];
    bvec2 clamped = bvec2((t.flags & TEXTURE_CLAMP_U) != 0u, (t.flags & TEXTURE_CLAMP_V) != 0u);
    bvec2 mirrored = bvec2((t.flags & TEXTURE_MIRROR_U) != 0u, (t.flags & TEXTURE_MIRROR_V) != 0u);
    vec2 folded = vec2(wrapCoordinate(uv.x, clamped.x, mirrored.x), wrapCoordinate(uv.y, clamped.y, mirrored.y));
    bool nearest = (t.flags & TEXTURE_NEAREST) != 0u, srgb = (t.flags & TEXTURE_SRGB) != 0u;

    lod = clamp(lod, 0.0, float(t.mips - 1u));
    uint level = uint(lod);
    float share = lod - float(level);
    uint first = 0u;
    for (uint l = 0u; l < level; ++l) first += max(1u, t.width >> l) * max(1u, t.height >> l);

    vec4 color = vec4(0.0);
    for (uint i = 0u; i < (share > 0.0 ? 2u : 1u); ++i) {
        ivec2 size = ivec2(max(1u, t.width >> (level + i)), max(1u, t.height >> (level + i)));
        vec2 f;
        ivec2 x = texelPair(folded.x, size.x, !(clamped.x || mirrored.x), nearest, f.x);
        ivec2 y = texelPair(folded.y, size.y, !(clamped.y || mirrored.y), nearest, f.y);
        UintArray texels = UintArray(t.texels);
        uint top = first + uint(y.x * size.x), bottom = first + uint(y.y * size.x);
        vec4 upper = mix(decodeTexel(texels.at[top + uint(x.x)], srgb), decodeTexel(texels.at[top + uint(x.y)], srgb), f.x);
        vec4 lower = mix(decodeTexel(texels.at[bottom + uint(x.x)], srgb), decodeTexel(texels.at[bottom + uint(x.y)], srgb), f.x);
        color += (i == 0u ? 1.0 - share : share) * mix(upper, lower, f.y);
        first += uint(size.x * size.y);
    }
    return color;
}
