#version 460
// SPDX-License-Identifier: MIT
// Traces given rays with the body that the compiler's defines choose; trace_agreement_test.cpp compares the answers.
#include "trace/trace.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Worlds { World value; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Rays { Ray at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Hits { Hit at[]; };
layout(push_constant, scalar) uniform Push {
    Worlds world;
    Rays rays;
    Hits hits;
    uint count, anyHit;
} push;

layout(local_size_x = 64) in;
void main() {
    uint i = gl_GlobalInvocationID.x;
    bool mine = i < push.count;
    Ray ray = push.rays.at[mine ? i : 0u];
    if (!mine) ray.tMax = -1.0;
    Hit hit = traceRay(push.world.value, ray, push.anyHit != 0u);
    if (mine) push.hits.at[i] = hit;
}
