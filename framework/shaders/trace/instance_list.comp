// SPDX-License-Identifier: MIT
// Writes what the driver's top level is built of: each instance with the bottom level of the level of detail that it shows.
#version 460
#include "world/world.h"

layout(local_size_x = 64) in;

// VkAccelerationStructureInstanceKHR
struct QueryInstance {
    vec4 toWorld[3];
    uint customIndexAndMask;
    uint offsetAndFlags;
    uint64_t bottomLevel;  // 0: never hit
};

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer QueryInstances { QueryInstance at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer WorldMemory { World world; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Addresses { uint64_t at[]; };

layout(push_constant, scalar) uniform Push {
    WorldMemory world;
    QueryInstances instances;
} push;

void main() {
    World w = push.world.world;
    uint i = gl_GlobalInvocationID.x;
    if (i >= w.instanceCount) return;
    const uint facingCullDisable = 1u;
    InstanceRecord instance = w.instances.at[i];
    uint64_t shown = 0ul;
    bool isShown = (instance.flags & INSTANCE_HIDDEN) == 0u && w.levels.at[i] < LEVELS;
    if (isShown) shown = Addresses(w.bottomLevels).at[instance.mesh * LEVELS + w.levels.at[i]];
    push.instances.at[i] = QueryInstance(instance.toWorld, 0xff000000u, facingCullDisable << 24, shown);
}
