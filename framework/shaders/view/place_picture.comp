// SPDX-License-Identifier: MIT
// Lays coloured texels out in the viewport of a window: zoomed, moved, or warped to where the camera has gone meanwhile.
#version 460
#include "view/picture.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint at[]; };

layout(push_constant, scalar) uniform PushConstants { PlacePicture push; };

uint colorAt(vec2 place) {
    const vec3 w = vec3(place, 1);
    const float depth = dot(push.row2, w);
    const ivec2 p = ivec2(floor(clamp(vec2(dot(push.row0, w), dot(push.row1, w)) / depth, -1e6, 1e6)));
    if (!(depth > 1e-6) || any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, ivec2(push.size)))) return push.background;
    return Words(push.colors).at[uint(p.y) * push.size.x + uint(p.x)];
}

void main() {
    const uvec2 p = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(p, push.viewport))) return;
    uint word = 0u;
    if (push.samples == 1u) {
        word = colorAt(vec2(p) + 0.5);
    } else {
        vec4 sum = vec4(0);
        for (uint y = 0u; y < push.samples; ++y)
            for (uint x = 0u; x < push.samples; ++x) sum += unpackUnorm4x8(colorAt(vec2(p) + (vec2(x, y) + 0.5) / float(push.samples)));
        word = packUnorm4x8(sum / float(push.samples * push.samples));
    }
    Words(push.target).at[p.y * push.viewport.x + p.x] = word;
}
