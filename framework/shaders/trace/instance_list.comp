// SPDX-License-Identifier: MIT
// Writes what the driver's top level is built of: each instance with the bottom level of the level of detail that it shows. Where instances dissolve, as
// many again follow for the next coarser levels; those that aren't seen in these are never hit and cost a traversal nothing.
#version 460
#include "world/ray_levels.glsl"

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

// A ray of number x sees what has bit x / 2^29 in its mask. The masks of a share in eighths say it all; of another share, and of an instance with
// numbers of its own, every candidate triangle is asked (trace/ray_query.glsl).
bool fitsMask(uint dissolve) { return (dissolve & DISSOLVE_EACH) == 0u && (dissolve & 0x1fffff00u) == 0u; }

void main() {
    World w = push.world.world;
    uint entry = gl_GlobalInvocationID.x, i = entry % w.instanceCount;
    bool dissolves = uint64_t(w.dissolves) != 0ul, coarser = entry >= w.instanceCount;
    if (entry >= (dissolves ? 2u : 1u) * w.instanceCount) return;
    const uint facingCullDisable = 1u, forceNoOpaque = 8u;
    InstanceRecord instance = w.instances.at[i];
    uint dissolve = dissolves ? w.dissolves.at[i] : 0u, level = w.levels.at[i] + (coarser ? 1u : 0u), mask = 0xffu;
    bool isAsked = dissolve != 0u && !fitsMask(dissolve);
    if (dissolve != 0u && !isAsked) mask = (1u << (dissolve >> 29)) - 1u ^ (coarser ? 0u : 0xffu);
    bool isShown = (instance.flags & INSTANCE_HIDDEN) == 0u && level < LEVELS && (!coarser || dissolve != 0u);
    uint64_t shown = isShown ? Addresses(w.bottomLevels).at[instance.mesh * LEVELS + level] : 0ul;
    push.instances.at[entry] = QueryInstance(instance.toWorld, mask << 24, (facingCullDisable | (isAsked ? forceNoOpaque : 0u)) << 24, shown);
}
