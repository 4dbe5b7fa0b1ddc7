// SPDX-License-Identifier: MIT
// Node references and the memory that both software traversals read; scene/bvh/bvh.h says how nodes and triangles are laid out.
#include "world/world.h"
#include "world/ray.h"
#include "world/ray_levels.glsl"
#include "world/triangle.glsl"

const uint REF_LEAF = 0x80000000u;      // | (count - 1) << 28 | REF_MASKED when one of the triangles has an alpha mask | first triangle
const uint REF_MASKED = 0x08000000u;
const uint REF_BACK = 0xd0000000u;      // return from an instance
const uint REF_INSTANCE = 0xe0000000u;  // | instance
const uint REF_COARSER = 0x10000000u;   // of an instance: entered by those rays alone that see the coarser of its two levels
const uint REF_INSTANCE_BITS = 0x0fffffffu;
const uint REF_NONE = 0xffffffffu;

/// A World that shows one of its instances alone, whatever else is there.
World onlyInstance(World w, uint instance) {
    w.topRoot = REF_INSTANCE | instance;
    return w;
}

// One over each component of a ray's direction. Zero gets a huge slope instead of an infinite one: infinity times zero is no number.
vec3 inverseOf(vec3 direction) {
    const float least = 1e-18;
    return 1.0 / mix(direction, vec3(least), lessThan(abs(direction), vec3(least)));
}

uint firstTriangle(uint leaf) { return leaf & 0x07ffffffu; }
uint lastTriangle(uint leaf) { return firstTriangle(leaf) + ((leaf >> 28) & 3u); }

// A world-space point and direction in the grid of an instance (world/world.h, TraceInstance). The direction's length changes with the space,
// so t means the same in both.
vec3 pointToGrid(vec4 x, vec4 y, vec4 z, vec3 point) {
    vec3 p = point - vec3(x.w, y.w, z.w);
    return vec3(dot(x.xyz, p), dot(y.xyz, p), dot(z.xyz, p));
}
vec3 directionToGrid(vec4 x, vec4 y, vec4 z, vec3 d) { return vec3(dot(x.xyz, d), dot(y.xyz, d), dot(z.xyz, d)); }

/// Takes a ray to where an instance stood when the shutter opened, for which it was laid out: it stands there as the ray stands to it now.
void intoOpening(World w, uint instance, inout vec3 origin, inout vec3 direction) {
    if (MOTION_BLUR == 0 || (w.instances.at[instance].flags & INSTANCE_MOVES) == 0u) return;
    Placement now = placementOf(w, instance);
    w.time = 0.0;
    Placement then = placementOf(w, instance);
    // The inverse of a matrix of rows r has the columns r1 x r2, r2 x r0, r0 x r1, over its determinant.
    vec3 x = cross(now.row1, now.row2), y = cross(now.row2, now.row0), z = cross(now.row0, now.row1);
    float scale = 1.0 / dot(now.row0, x);
    vec3 p = origin - now.translation;
    origin = placePoint(then, scale * (p.x * x + p.y * y + p.z * z));
    direction = placeVector(then, scale * (direction.x * x + direction.y * y + direction.z * z));
}

// The root that an instance shows: its level is read where it is entered, so a switch of levels rebuilds nothing. Without triangles, or beyond all levels
// (which is how passes hide an instance): straight back.
uint rootOf(World w, uint mesh, uint level) {
    uint root = REF_NONE;
    if (level < LEVELS) root = w.roots.at[mesh * LEVELS + level];
    return root == REF_NONE ? REF_BACK : root;
}

#ifdef COUNT_STEPS
uint traceSteps = 0u;  // nodes that this invocation's rays visited
#endif
