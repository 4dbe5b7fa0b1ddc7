// SPDX-License-Identifier: MIT
// Turns a port's texels into colours of the screen, and reads the texel under the pointer.
#version 460
#include "base/tone_curve.glsl"
#include "view/picture.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 2) readonly buffer Halves { uint16_t at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 1) readonly buffer Bytes { uint8_t at[]; };

layout(push_constant, scalar) uniform PushConstants { ColorTexels push; };

const vec3 invalid = vec3(0.0, 0.88, 0.38);  // a green that no look gives: not a number, or infinite

uint bitsAt(uint64_t texels, uvec2 p, uint channel) {
    const uint64_t texel = texels + uint64_t(p.y * push.size.x + p.x) * push.stride + push.offset;
    if (push.number == NUMBER_FLOAT16 || push.number == NUMBER_UINT16) return uint(Halves(texel).at[channel]);
    if (push.number == NUMBER_UNORM8 || push.number == NUMBER_UINT8) return uint(Bytes(texel).at[channel]);
    return Words(texel).at[channel];
}

float valueOf(uint bits) {
    switch (push.number) {
    case NUMBER_FLOAT32: return uintBitsToFloat(bits);
    case NUMBER_FLOAT16: return unpackHalf2x16(bits).x;
    case NUMBER_UNORM8: return float(bits) / 255.0;
    case NUMBER_INT32: return float(int(bits));
    default: return float(bits);
    }
}

/// Components that a texel hasn't are 0.
vec4 texel(uvec2 p) {
    vec4 v = vec4(0);
    for (uint c = 0u; c < push.channels; ++c) {
        v[c] = valueOf(bitsAt(push.texels, p, c));
        if (push.minus != 0ul) v[c] = abs(v[c] - valueOf(bitsAt(push.minus, p, c)));
    }
    return v;
}

float picked(vec4 v) {
    if (push.pick == PICK_LUMINANCE) return luminance(v.rgb);
    return push.pick == PICK_LENGTH ? length(v) : v[push.pick];
}

vec3 encode(vec3 c) { return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308))); }

vec3 colorOf(uvec2 p) {
    if (push.look == LOOK_IDS) {
        const uint channel = min(push.pick, push.channels - 1u);
        uint h = bitsAt(push.texels, p, channel);
        if (h == ~0u || (push.minus != 0ul && h == bitsAt(push.minus, p, channel))) return vec3(0.1);  // none, or no other
        h = (h ^ (h >> 16u)) * 0x7feb352du;
        h = (h ^ (h >> 15u)) * 0x846ca68bu;
        return 0.25 + 0.7 * unpackUnorm4x8(h ^ (h >> 16u)).rgb;
    }
    const vec4 v = texel(p);
    if (any(isnan(v)) || any(isinf(v))) return invalid;
    if (push.look == LOOK_SIGNED) return 0.5 + 0.5 * v.rgb / max(push.high, 1e-30);
    if (push.look == LOOK_GREY || push.look == LOOK_HEAT) {
        const float t = clamp((picked(v) - push.low) / max(push.high - push.low, 1e-30), 0, 1);
        return push.look == LOOK_GREY ? vec3(t) : unpackUnorm4x8(Words(push.ramp).at[uint(t * 255.0 + 0.5)]).rgb;
    }
    vec3 c = max((push.channels == 1u ? v.rrr : v.rgb) * push.scale, vec3(0));
    if (push.curve == 1u) c = toneNeutral(c);
    else if (push.curve == 2u) c = toneAces(c);
    else if (push.curve == 3u) c = toneReinhard(c);
    return encode(clamp(c, 0, 1));
}

void main() {
    const uvec2 p = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(p, push.size))) return;
    if (p == uvec2(0) && all(greaterThanEqual(push.probePixel, ivec2(0))) && all(lessThan(push.probePixel, ivec2(push.size))))
        for (uint c = 0u; c < push.channels; ++c) Words(push.probe).at[c] = bitsAt(push.texels, uvec2(push.probePixel), c);
    if (push.probeOnly != 0u) return;
    const vec3 c = clamp(colorOf(p), 0, 1);
    Words(push.colors).at[p.y * push.size.x + p.x] = packUnorm4x8(vec4(push.swapped != 0u ? c.bgr : c, 1));
}
