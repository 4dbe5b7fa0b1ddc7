// SPDX-License-Identifier: MIT
// Unit vectors in 32 bits and colours in 64; framework/scene/upload/pack.h is the same in C++.
//
// Unit vector: octahedral map (Meyer et al. 2010; Cigolle et al. 2014, A Survey of Efficient Representations for Independent Unit
// Vectors), x in bits 0-15, y in bits 16-31, each a two's complement integer round(32767 * coordinate).
// Tangent: the same with bit 0 replaced by the sign: 1 means bitangent = -cross(normal, tangent). The word 0 means "no tangent"; the one
// direction that would give it, +Z with sign 0, is stored as 0x00010000.
// Colour: half floats, red in bits 0-15 of the first word, blue in those of the second.
#include "base/math.glsl"

const uint TANGENT_NONE = 0u;

/// The octahedral map, to [-1, 1]^2 and back to a unit vector.
vec2 octahedral(vec3 n) {
    n /= abs(n.x) + abs(n.y) + abs(n.z);
    vec2 folded = (1.0 - abs(n.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(n.xy, vec2(0.0)));
    return clamp(n.z >= 0.0 ? n.xy : folded, -1.0, 1.0);
}

vec3 fromOctahedral(vec2 p) {
    precise vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));  // the same in each kernel: a direction that is stored is what its path is
    float fold = max(-n.z, 0.0);
    n.x += n.x >= 0.0 ? -fold : fold;
    n.y += n.y >= 0.0 ? -fold : fold;
    precise float squared = dot(n, n);
    n *= inversesqrt(squared);
    return n;
}

uint packNormal(vec3 n) {
    ivec2 q = ivec2(floor(octahedral(n) * 32767.0 + 0.5));
    return uint(q.x & 0xffff) | uint(q.y) << 16;
}

vec3 unpackNormal(uint bits) { return fromOctahedral(max(vec2(int(bits << 16) >> 16, int(bits) >> 16) * (1.0 / 32767.0), -1.0)); }

/// A unit direction on a grid of 2^-19 in octahedral coordinates, 2e-6 radians: no finer, so that packing what was unpacked gives the same direction again.
const float DIRECTION_STEPS = 524287.0;

uvec2 packDirection(vec3 d) {
    return uvec2(ivec2(floor(octahedral(d) * DIRECTION_STEPS + 0.5)));
}

vec3 unpackDirection(uvec2 bits) { return fromOctahedral(vec2(ivec2(bits)) * (1.0 / DIRECTION_STEPS)); }

uint packTangent(vec4 tangent) {
    uint bits = (packNormal(tangent.xyz) & ~1u) | (tangent.w < 0.0 ? 1u : 0u);
    return bits == TANGENT_NONE ? 0x00010000u : bits;
}

/// xyz: tangent, w: sign of the bitangent cross(normal, tangent).
vec4 unpackTangent(uint bits) { return vec4(unpackNormal(bits & ~1u), (bits & 1u) != 0u ? -1.0 : 1.0); }

uvec2 packColor(vec4 color) { return uvec2(packHalf2x16(color.rg), packHalf2x16(color.ba)); }
vec4 unpackColor(uvec2 bits) { return vec4(unpackHalf2x16(bits.x), unpackHalf2x16(bits.y)); }
