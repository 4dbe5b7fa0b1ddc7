// SPDX-License-Identifier: MIT
// Draws a port's texels into the viewport of a window: zoomed, coloured, encoded; and reads the texel under the pointer.
#version 460
#include "base/tone_curve.glsl"
#include "view/picture_block.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer BlockMemory { PictureBlock block; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 2) readonly buffer Halves { uint16_t at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 1) readonly buffer Bytes { uint8_t at[]; };

layout(push_constant, scalar) uniform PushConstants { uint64_t address; };
#define block BlockMemory(address).block

const uint invalid = 0x60e000u;  // a green that no look gives: not a number, or infinite

uint bitsAt(ivec2 p, uint channel) {
    const uint64_t texel = block.texels + uint64_t(uint(p.y) * block.size.x + uint(p.x)) * block.stride + block.offset;
    if (block.number == NUMBER_FLOAT16 || block.number == NUMBER_UINT16) return uint(Halves(texel).at[channel]);
    if (block.number == NUMBER_UNORM8 || block.number == NUMBER_UINT8) return uint(Bytes(texel).at[channel]);
    return Words(texel).at[channel];
}

float valueOf(uint bits) {
    switch (block.number) {
    case NUMBER_FLOAT32: return uintBitsToFloat(bits);
    case NUMBER_FLOAT16: return unpackHalf2x16(bits).x;
    case NUMBER_UNORM8: return float(bits) / 255.0;
    case NUMBER_INT32: return float(int(bits));
    default: return float(bits);
    }
}

vec4 texel(ivec2 p) {
    vec4 v = vec4(0, 0, 0, 1);
    for (uint c = 0u; c < block.channels; ++c) v[c] = valueOf(bitsAt(p, c));
    return v;
}

float picked(vec4 v) {
    if (block.pick == PICK_LUMINANCE) return luminance(v.rgb);
    if (block.pick != PICK_LENGTH) return v[block.pick];
    if (block.channels < 4u) v.w = 0.0;
    return length(v);
}

vec3 encode(vec3 c) { return mix(1.055 * pow(max(c, vec3(0)), vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308))); }

vec3 unpacked(uint word) { return unpackUnorm4x8(word).rgb; }

// Display-encoded colour of a texel.
vec3 colorOf(ivec2 p) {
    if (block.look == LOOK_IDS) {
        uint h = bitsAt(p, min(block.pick, block.channels - 1u));
        if (h == ~0u) return vec3(0.1);
        h = (h ^ (h >> 16u)) * 0x7feb352du;
        h = (h ^ (h >> 15u)) * 0x846ca68bu;
        h ^= h >> 16u;
        return 0.25 + 0.7 * unpacked(h);
    }
    const vec4 v = texel(p);
    vec4 seen = v;
    for (uint c = block.channels; c < 4u; ++c) seen[c] = 0.0;
    if (any(isnan(seen)) || any(isinf(seen))) return unpacked(invalid);
    const float range = max(block.high - block.low, 1e-30);
    switch (block.look) {
    case LOOK_SIGNED: {
        vec3 s = 0.5 + 0.5 * v.rgb / max(block.high, 1e-30);
        for (uint c = block.channels; c < 3u; ++c) s[c] = 0.5;
        return clamp(s, 0, 1);
    }
    case LOOK_GREY: return vec3(clamp((picked(v) - block.low) / range, 0, 1));
    case LOOK_HEAT: return unpacked(Words(block.colors).at[uint(clamp((picked(v) - block.low) / range, 0, 1) * 255.0 + 0.5)]);
    }
    vec3 c = block.channels == 1u ? vec3(v.x) : v.rgb;
    if (block.channels == 2u) c.b = 0.0;
    c = max(c * block.scale, vec3(0));
    if (block.curve == 1u) c = toneNeutral(c);
    else if (block.curve == 2u) c = toneAces(c);
    else if (block.curve == 3u) c = toneReinhard(c);
    return encode(clamp(c, 0, 1));
}

vec2 imagePlace(vec2 window) {
    const vec3 w = vec3(window, 1);
    const float depth = dot(block.row2, w);
    return depth > 1e-6 ? vec2(dot(block.row0, w), dot(block.row1, w)) / depth : vec2(-1e9);
}

bool within(ivec2 p) { return all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, ivec2(block.size))); }

void main() {
    if (address == 0ul) return;  // only compiling
    const uvec2 p = gl_GlobalInvocationID.xy;
    if (p == uvec2(0) && within(block.probePixel))
        for (uint c = 0u; c < block.channels; ++c) Words(block.probe).at[c] = bitsAt(block.probePixel, c);
    if (any(greaterThanEqual(p, block.viewport))) return;

    const vec2 centre = vec2(p) + 0.5, place = imagePlace(centre);
    const vec2 footprint = abs(imagePlace(centre + 0.5) - imagePlace(centre - 0.5));
    const int samples = clamp(int(ceil(max(footprint.x, footprint.y) - 0.01)), 1, 4);  // pixels averaged where the image is shown small
    vec3 sum = vec3(0);
    for (int y = 0; y < samples; ++y)
        for (int x = 0; x < samples; ++x) {
            const vec2 at = samples == 1 ? place : imagePlace(centre + (vec2(x, y) + 0.5) / float(samples) - 0.5);
            const ivec2 source = ivec2(floor(at));
            sum += within(source) ? colorOf(source) : unpacked(block.background);
        }
    vec3 c = sum / float(samples * samples);
    Words(block.target).at[p.y * block.viewport.x + p.x] = packUnorm4x8(vec4(block.swapped != 0u ? c.bgr : c, 1));
}
