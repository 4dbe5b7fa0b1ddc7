// SPDX-License-Identifier: MIT
// Levels that are chosen ray by ray: while an instance passes from one level to the next coarser one, a share of the rays sees that already (stochastic
// levels of detail; "Implementing Stochastic Levels of Detail with Microsoft DirectX Raytracing", NVIDIA 2020). A ray carries a number, all rays of a path
// the same, so that they see one scene: with another number a shadow ray would start inside of what it left.
//
// Graphs in which some pass makes instances dissolve are compiled with RAY_LEVELS (pass/pass.h, Fact); in others, unless paths choose times as well
// (world/exposure.glsl), the number isn't even drawn.
#include "base/random.glsl"
#include "world/scene_facts.glsl"
#include "world/world.h"

// World.dissolves: bits 8 to 31 say below which numbers rays see the coarser level, out of 2^24.
const uint DISSOLVE_EACH = 1u;  // the instance has a number of its own for each ray; without, it shares the ray's with all others

// Ray.flags, bits 8 to 31.
const uint RAY_NUMBER = 0xffffff00u;

/// That of a path, which has it from its seed.
uint numberOfPath(uvec2 seed) { return !RAY_NUMBERS ? 0u : randomBits3(seed, 0u, RANDOM_LEVEL).x & RAY_NUMBER; }

/// That of a pixel in the frame of `w`: of its camera ray, and of what starts from where that ends.
uint numberOfPixel(World w, ivec2 pixel) {
    return !RAY_NUMBERS ? 0u : randomBits3(uvec2(pixel), w.frameKey, RANDOM_LEVEL).x & RAY_NUMBER;
}

/// Whether rays of a number see the coarser of the two levels of an instance.
bool seesCoarser(World w, uint instance, uint number) {
    if (RAY_LEVELS == 0 || uint64_t(w.dissolves) == 0ul) return false;
    uint dissolve = w.dissolves.at[instance];
    if ((dissolve & DISSOLVE_EACH) != 0u) number = randomBits3(uvec2(number & RAY_NUMBER, instance), 0u, RANDOM_LEVEL).x;
    return (number >> 8) < (dissolve >> 8);
}

/// The level that rays of a number see of an instance; LEVELS or more: it is hidden.
uint levelSeen(World w, uint instance, uint number) { return w.levels.at[instance] + (seesCoarser(w, instance, number) ? 1u : 0u); }
