// SPDX-License-Identifier: MIT
// Which points of the mesh some view sees: from each, a ray towards the camera of each view, until one is free.
#version 460
#include "pass.glsl"
#include "base/random.glsl"
#include "store_texel.glsl"
#include "trace/reference.glsl"
#include "trace/trace.glsl"

struct Path {
    Hit point;
    Ray ray;
    bool seen;
};

World world() { return onlyInstance(objects(), job().mesh); }
uint pathItems(World now) { return impostors().views; }
World pathWorld(World now, uint item) { return now; }

float twiceArea(World w, uint primitive) {
    TrianglePoint p = pointOn(w, cornersOf(w, primitive), vec2(0));
    return length(cross(p.edge1, p.edge2));
}

// One of some triangles by area, and a point of it.
void pathStart(inout Path p, World now, ivec2 pixel) {
    LevelRecord level = now.meshLevels.at[job().mesh * LEVELS];
    uvec2 seed = resamplingSeed(uvec2(pixel), 0u, runSeed(), passSalt());
    const uint candidates = 64;
    uint primitive = level.firstPrimitive;
    float sum = 0;
    for (uint i = 1; i <= candidates; ++i) {
        uvec3 bits = randomBits3(seed, i, RANDOM_FREE);
        uint candidate = level.firstPrimitive + scaledIndex(bits.x, level.primitiveCount);
        float area = twiceArea(now, candidate);
        sum += area;
        if (unitFloat(bits.y) * sum < area) primitive = candidate;
    }
    vec2 u = random2(seed, 0, RANDOM_FREE);
    float root = sqrt(u.x);
    p.point = Hit(0.0, vec2(1 - root, root * u.y), primitive, job().mesh);
    if (!alphaAccepts(now, primitive, p.point.barycentrics)) p.point.primitive = NONE;
    p.seen = false;
}

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    if (p.point.primitive == NONE || p.seen) return false;
    vec3 towards = viewDirection(impostors().views, item);
    p.ray = spawnRay(w, surfaceAt(w, p.point, -towards), towards);
    return true;
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) {
    anyHit = true;
    purpose = RAYS_VISIBILITY;
    return p.ray;
}

bool pathStep(inout Path p, World w, Hit hit) {
    p.seen = hit.primitive == NONE;
    return false;
}

void pathItemEnd(inout Path p, World w, ivec2 pixel, uint item) {}

void pathEnd(Path p, ivec2 pixel) {
    if (p.point.primitive == NONE) return;
    addCoverage(0u, 1u);
    if (p.seen) addCoverage(1u, 1u);
}

#include "trace/driver.glsl"
