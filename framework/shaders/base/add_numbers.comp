// SPDX-License-Identifier: MIT
// Adds its index to each number: the least that a device has to be able to do (lodestir devices --test).
#version 460

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Numbers { uint at[]; };
layout(push_constant, scalar) uniform Push {
    Numbers numbers;
} push;

void main() {
    uint i = gl_GlobalInvocationID.x;
    push.numbers.at[i] += i;
}
