#version 460
// SPDX-License-Identifier: MIT
// Traces given rays and stores their hits. BENCH_RAY_QUERY: with the driver's own ray query instead of one of trace/'s bodies.
#ifdef BENCH_RAY_QUERY
#extension GL_EXT_ray_query : require
#include "world/ray.h"
#include "world/world.h"

Hit traceRay(World w, Ray ray, bool anyHit) {
    uint flags = gl_RayFlagsOpaqueEXT | (anyHit ? gl_RayFlagsTerminateOnFirstHitEXT : 0u);
    rayQueryEXT query;
    rayQueryInitializeEXT(query, accelerationStructureEXT(w.tlas), flags, 0xff, ray.origin, ray.tMin, ray.direction, ray.tMax);
    while (rayQueryProceedEXT(query)) {}
    if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT) return Hit(ray.tMax, vec2(0.0), NONE, NONE);
    return Hit(rayQueryGetIntersectionTEXT(query, true), rayQueryGetIntersectionBarycentricsEXT(query, true),
               rayQueryGetIntersectionPrimitiveIndexEXT(query, true), rayQueryGetIntersectionInstanceIdEXT(query, true));
}
#else
#include "trace/trace.glsl"
#endif

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Worlds { World value; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Rays { Ray at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Hits { Hit at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counter { uint value; };
layout(push_constant, scalar) uniform Push {
    Worlds world;
    Rays rays;
    Hits hits;
    Counter counter;
    uvec2 size;
    uint anyHit;
} push;

// Tiles of 8x8 pixels are fetched from a counter by each subgroup, as trace/driver.glsl does on a CPU driver.
layout(local_size_x = 64) in;
void main() {
    World w = push.world.value;
    uvec2 tiles = push.size / 8u;
    for (;;) {
        uint tile = 0u;
        if (subgroupElect()) tile = atomicAdd(push.counter.value, 1u);
        tile = subgroupBroadcastFirst(tile);
        if (tile >= tiles.x * tiles.y) break;
        for (uint first = 0u; first < 64u; first += gl_SubgroupSize) {
            uint place = first + gl_SubgroupInvocationID;
            uvec2 inBlock = uvec2(place & 3u, (place >> 2) & 1u), block = uvec2((place >> 3) & 1u, place >> 4);
            uvec2 pixel = uvec2(tile % tiles.x, tile / tiles.x) * 8u + block * uvec2(4u, 2u) + inBlock;
            uint i = pixel.y * push.size.x + pixel.x;
            push.hits.at[i] = traceRay(w, push.rays.at[i], push.anyHit != 0u);
        }
    }
}
