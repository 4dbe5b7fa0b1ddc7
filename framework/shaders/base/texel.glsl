// SPDX-License-Identifier: MIT
// Texel formats: an image is a row-major array of stored texels; decodeX and encodeX turn one into what the shader sees and back.
// A store of a texel touches that texel's bytes only: the formats of 2 bytes are stored with 16 bits, so neighbours never race.
// ...Rgba shows any format as a colour: one channel as grey, two as (x, y, 0), missing alpha as 1.

#define LODESTIR_TEXELS(Name, Stored)                                                                            \
    layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer In##Name { Stored at[]; };     \
    layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Out##Name { Stored at[]; };

LODESTIR_TEXELS(R16f, uint16_t)
LODESTIR_TEXELS(Rg16f, uint)
LODESTIR_TEXELS(Rgba16f, uvec2)
LODESTIR_TEXELS(R32f, float)
LODESTIR_TEXELS(Rg32f, vec2)
LODESTIR_TEXELS(Rgba32f, vec4)
LODESTIR_TEXELS(Rgba8, uint)
LODESTIR_TEXELS(R32ui, uint)

float decodeR16f(uint16_t stored) { return unpackHalf2x16(uint(stored)).x; }
vec2 decodeRg16f(uint stored) { return unpackHalf2x16(stored); }
vec4 decodeRgba16f(uvec2 stored) { return vec4(unpackHalf2x16(stored.x), unpackHalf2x16(stored.y)); }
float decodeR32f(float stored) { return stored; }
vec2 decodeRg32f(vec2 stored) { return stored; }
vec4 decodeRgba32f(vec4 stored) { return stored; }
vec4 decodeRgba8(uint stored) { return unpackUnorm4x8(stored); }
uint decodeR32ui(uint stored) { return stored; }

uint16_t encodeR16f(float value) { return uint16_t(packHalf2x16(vec2(value, 0))); }
uint encodeRg16f(vec2 value) { return packHalf2x16(value); }
uvec2 encodeRgba16f(vec4 value) { return uvec2(packHalf2x16(value.xy), packHalf2x16(value.zw)); }
float encodeR32f(float value) { return value; }
vec2 encodeRg32f(vec2 value) { return value; }
vec4 encodeRgba32f(vec4 value) { return value; }
uint encodeRgba8(vec4 value) { return packUnorm4x8(value); }
uint encodeR32ui(uint value) { return value; }

vec4 asRgba(float value) { return vec4(vec3(value), 1); }
vec4 asRgba(vec2 value) { return vec4(value, 0, 1); }
vec4 asRgba(vec4 value) { return value; }
vec4 asRgba(uint value) { return vec4(vec3(value), 1); }

uint texelIndex(ivec2 p, uvec2 size) { return uint(p.y) * size.x + uint(p.x); }
