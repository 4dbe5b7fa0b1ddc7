// SPDX-License-Identifier: MIT
// main() of a shader that traces: carries every pixel's paths through one loop with one call of traceRay, as packets need.
//
// The includer defines, before it includes this file,
//   struct Path { ... };                                      all that a pixel keeps from ray to ray and from item to item
//   uint pathItems(World now);                                paths of a pixel, walked one after the other (samples, shifts, ...); at least 1
//   World pathWorld(World now, uint item);                    that the item's rays are traced in
//   void pathStart(inout Path path, World now, ivec2 pixel);  before item 0, when `path` holds nothing yet
//   bool pathBegin(inout Path path, World w, ivec2 pixel, uint item);  begins an item; false: it has no ray
//   Ray pathRay(inout Path path, out bool anyHit, out uint purpose);   the next ray; anyHit: only whether it hits matters; RAYS_... for the ledger
//   bool pathStep(inout Path path, World w, Hit hit);         goes on from what that ray hit; false: there is no other ray
//   void pathItemEnd(inout Path path, World w, ivec2 pixel, uint item);  after the item's last ray, also where it had none
//   void pathEnd(Path path, ivec2 pixel);                     after the last item
// and, if it defines PATH_NUMBER as well,
//   uint pathNumber(Path path, World w, ivec2 pixel);         by which an item's rays choose levels (world/ray_levels.glsl); without: the pixel's
// and, if it defines PATH_TIME,
//   float pathTime(Path path);                                at which an item's rays see the scene (world/exposure.glsl); without: that of their number
// where `now` is the pass's input `world`, read once, and `w` is seen at the item's time but for pathBegin, which chooses it. pathRay may be called several
// times for one ray, and so has to give the same one. The whole subgroup walks in step: its paths alternate between nearest-hit and any-hit rays, and one that
// wants the other kind waits (measured to beat both lanes that go their own way and lanes that start their next path early).
//
// It may define DRIVER_PIXEL(place), the pixel that stands at a place of the dispatch, where pixels are walked in another order.
//
// pass.glsl gives `push` (base/frame.h) and countRays.
#include "trace/known_ray.glsl"
#include "trace/trace.glsl"
#include "world/exposure.glsl"

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer DriverCounter { uint value; };

// Pixels come in tiles of 8x8, or in rows of 64 where the extent is one pixel high. Eight lanes in a row hold a block of 4x2 pixels.
uvec2 driverTiles() {
    uvec2 size = push.extent - push.base;
    if (push.rows != 0u) {
        if (push.extent.y == 1u) size.x = min(size.x, push.rows);
        else size.y = min(size.y, push.rows);
    }
    return size.y == 1u ? uvec2((size.x + 63u) / 64u, 1u) : (size + 7u) / 8u;
}
ivec2 driverPixel(uvec2 tile, uint place) {
    if (push.extent.y - push.base.y == 1u) return ivec2(push.base + uvec2(tile.x * 64u + place, 0u));
    uvec2 inBlock = uvec2(place & 3u, (place >> 2) & 1u), block = uvec2((place >> 3) & 1u, place >> 4);
    return ivec2(push.base + tile * 8u + block * uvec2(4u, 2u) + inBlock);
}

// Rays traced so far by purpose, 0-2 and 3-5.
uvec3 driverRays[2] = uvec3[](uvec3(0u), uvec3(0u));

void driverCount(uint purpose) {
    driverRays[0] += uvec3(equal(uvec3(purpose), uvec3(0u, 1u, 2u)));
    driverRays[1] += uvec3(equal(uvec3(purpose), uvec3(3u, 4u, 5u)));
}

#ifndef PATH_NUMBER
uint pathNumber(Path path, World w, ivec2 pixel) { return numberOfPixel(w, pixel); }
#endif

World driverWorld(Path path, World w, ivec2 pixel) {
#ifdef PATH_TIME
    return atTime(w, pathTime(path));
#else
    return atTime(w, pathNumber(path, w, pixel));
#endif
}

void driverWalk(ivec2 pixel) {
    bool inside = all(lessThan(uvec2(pixel), push.extent));
#ifdef DRIVER_PIXEL
    if (inside) pixel = DRIVER_PIXEL(pixel);
#endif
    Path path;
    World now = world();
    uint items = pathItems(now);
    PROBE_START(pixel);
    if (inside) pathStart(path, now, pixel);
    for (uint item = 0u; item < items; ++item) {
        World w = pathWorld(now, item);
        bool live = inside && pathBegin(path, w, pixel, item);
        if (MOTION_BLUR != 0 && live) w = driverWorld(path, w, pixel);
        bool phase = false;  // which kind of ray the subgroup traces now
        while (subgroupAny(live)) {
            bool anyHit = false;
            uint purpose;
            Ray ray = knownRay(purpose);
            if (live) ray = pathRay(path, anyHit, purpose);
            bool mine = live && anyHit == phase;
            if (!mine) ray.tMax = -1.0;
            if (RAY_LEVELS != 0) ray.flags |= pathNumber(path, w, pixel);
            if (subgroupAny(mine)) {
                Hit hit = traceRay(w, ray, phase);
                if (mine) {
                    driverCount(purpose);
                    live = pathStep(path, w, hit);
                }
            }
            phase = !phase;
        }
        if (inside) pathItemEnd(path, w, pixel, item);
        PROBE_ITEM_DONE();
    }
    if (inside) pathEnd(path, pixel);
}

void main() {
    if (push.warm != 0u) return;
    uvec2 tiles = driverTiles();
#ifdef TRACE_PERSISTENT
    // A CPU driver splits workgroups over its threads beforehand, whatever they cost; so there are as many as threads, and they fetch tiles.
    // Each subgroup fetches its own: such a driver runs one to its end before it begins the workgroup's next, which finds none left.
    for (;;) {
        uint tile = 0u;
        if (subgroupElect()) tile = atomicAdd(DriverCounter(push.tileCounter).value, 1u);
        tile = subgroupBroadcastFirst(tile);
        if (tile >= tiles.x * tiles.y) break;
        for (uint first = 0u; first < 64u; first += gl_SubgroupSize)
            driverWalk(driverPixel(uvec2(tile % tiles.x, tile / tiles.x), first + gl_SubgroupInvocationID));
    }
#else
    driverWalk(driverPixel(gl_WorkGroupID.xy, gl_LocalInvocationIndex));
#endif
    for (uint i = 0u; i < 3u; ++i) {
        countRays(i, driverRays[0][i]);
        countRays(3u + i, driverRays[1][i]);
    }
#ifdef COUNT_STEPS
    countRays(RAYS_STEPS, traceSteps);
#endif
}
