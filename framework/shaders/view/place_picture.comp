// SPDX-License-Identifier: MIT
// Lays coloured texels out in the viewport of a window: zoomed, moved, or warped to where the camera has gone meanwhile.
#version 460
#include "view/picture.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint at[]; };

layout(push_constant, scalar) uniform PushConstants { PlacePicture push; };

/// Image coordinates of a place of the viewport; {-1, -1}: none.
vec2 imagePlace(vec2 place) {
    const vec3 w = vec3(place, 1);
    const float depth = dot(push.row2, w);
    const vec2 p = clamp(vec2(dot(push.row0, w), dot(push.row1, w)) / depth, -1e6, 1e6);
    return depth > 1e-6 && all(greaterThanEqual(p, vec2(0))) && all(lessThan(p, vec2(push.size))) ? p : vec2(-1);
}

uint texel(ivec2 p) { return Words(push.colors).at[uint(p.y) * push.size.x + uint(p.x)]; }

uint colorAt(vec2 place) {
    const vec2 p = imagePlace(place);
    return p.x < 0 ? push.background : texel(ivec2(p));
}

/// Between the middles of the four texels around it; at the rim, of the two or the one there are.
uint colorBetween(vec2 place) {
    const vec2 p = imagePlace(place);
    if (p.x < 0) return push.background;
    const vec2 corner = floor(p - 0.5), part = p - 0.5 - corner;
    vec4 sum = vec4(0);
    for (int i = 0; i < 4; ++i) {
        const ivec2 beside = ivec2(i & 1, i >> 1);
        const vec2 share = mix(1 - part, part, vec2(beside));
        sum += share.x * share.y * unpackUnorm4x8(texel(clamp(ivec2(corner) + beside, ivec2(0), ivec2(push.size) - 1)));
    }
    return packUnorm4x8(sum);
}

void main() {
    const uvec2 p = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(p, push.viewport))) return;
    uint word = 0u;
    if (push.samples == 0u) {
        word = colorBetween(vec2(p) + 0.5);
    } else if (push.samples == 1u) {
        word = colorAt(vec2(p) + 0.5);
    } else {
        vec4 sum = vec4(0);
        for (uint y = 0u; y < push.samples; ++y)
            for (uint x = 0u; x < push.samples; ++x) sum += unpackUnorm4x8(colorAt(vec2(p) + (vec2(x, y) + 0.5) / float(push.samples)));
        word = packUnorm4x8(sum / float(push.samples * push.samples));
    }
    Words(push.target).at[p.y * push.viewport.x + p.x] = word;
}
