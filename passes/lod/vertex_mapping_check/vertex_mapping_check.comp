// SPDX-License-Identifier: MIT
// One point a pixel: of what the pixel sees, or of the mesh, nearly uniform over its area.
#version 460
#include "pass.glsl"
#include "base/random.glsl"
#include "lod/vertex_mapping.glsl"

struct Start {
    uint mesh, from, to;
    uint primitive;
    vec2 barycentrics;
    float area;
};

float twiceArea(World w, uint primitive) {
    TrianglePoint p = pointOn(w, cornersOf(w, primitive), vec2(0));
    return length(cross(p.edge1, p.edge2));
}

#if HAS_hits
bool begin(World w, ivec2 pixel, out Start s) {
    PrimaryHit hit = hits(pixelIndex(pixel));
    if (hit.primitive == NONE) return false;
    s = Start(w.instances.at[hit.instance].mesh, w.levels.at[hit.instance], uint(params.to), hit.primitive, hit.barycentrics, 0);
    return s.from != s.to && w.meshes.at[s.mesh].levels > max(s.from, s.to);
}
#else
bool begin(World w, ivec2 pixel, out Start s) {
    if (uint(params.instance) >= w.instanceCount) return false;
    uint mesh = w.instances.at[params.instance].mesh;
    LevelRecord level = w.meshLevels.at[mesh * LEVELS + uint(params.from)];
    uvec2 seed = resamplingSeed(uvec2(pixel), frameIndex(), runSeed(), passSalt());
    // One of some triangles by area, so that a few large ones among many small ones don't make the sums of areas noisy.
    const uint candidates = 256;
    uint primitive = level.firstPrimitive;
    float sum = 0;
    for (uint i = 1; i <= candidates; ++i) {
        uvec3 bits = randomBits3(seed, i, RANDOM_FREE);
        uint candidate = level.firstPrimitive + scaledIndex(bits.x, level.primitiveCount);
        float area = 0.5 * twiceArea(w, candidate);
        sum += area;
        if (unitFloat(bits.y) * sum < area) primitive = candidate;
    }
    vec2 u = random2(seed, 0, RANDOM_FREE);
    float root = sqrt(u.x);
    s = Start(mesh, uint(params.from), uint(params.to), primitive, vec2(1 - root, root * u.y), sum / float(candidates) * float(level.primitiveCount));
    return true;
}
#endif

// Height of a triangle in UV, in steps of floats as large as the coordinate: what rounds off positions that are found by coordinate.
float thickness(World w, uint primitive, vec2 coordinate) {
    uvec3 corners = cornersOf(w, primitive);
    vec2 a = w.vertices.at[corners.x].uv0, b = w.vertices.at[corners.y].uv0, c = w.vertices.at[corners.z].uv0;
    float longest = max(distance(a, b), max(distance(b, c), distance(c, a))), grain = max(abs(coordinate.x), abs(coordinate.y)) * exp2(-23);
    return longest > 0 && grain > 0 ? twiceUvArea(w, primitive) / (longest * grain) : 0;
}

// Does a triangle of the other level that is not the partner lie nearer?
bool passesNearer(World w, UvFound there, vec3 position, MappedPoint partner) {
    float mine = distance(position, restPosition(w, partner.primitive, partner.barycentrics));
    for (uint i = 0; i < there.count; ++i)
        if (there.primitives[i] != partner.primitive && distance(position, restPosition(w, there.primitives[i], there.barycentrics[i])) < mine) return true;
    return false;
}

// Pushes a right triangle in UV through tau; 0 where it leaves the triangle on either side.
float finiteDifference(World w, Start s, vec2 coordinate, MappedPoint image) {
    uvec3 corners = cornersOf(w, s.primitive);
    float side = params.step * sqrt(min(twiceUvArea(w, s.primitive), twiceUvArea(w, image.primitive)));
    vec3 here[3], there[3];
    for (int i = 0; i < 3; ++i) {
        vec2 moved = coordinate + side * vec2(i == 1, i == 2);
        vec2 at = uvBarycentrics(w.vertices.at[corners.x].uv0, w.vertices.at[corners.y].uv0, w.vertices.at[corners.z].uv0, moved);
        if (at.x < 0) return 0;
        MappedPoint m = mapPoint(w, uv(), s.mesh, s.primitive, moved, s.from, s.to, params.matching);
        if (m.primitive != image.primitive) return 0;
        here[i] = restPosition(w, s.primitive, at);
        there[i] = restPosition(w, m.primitive, m.barycentrics);
    }
    return length(cross(there[1] - there[0], there[2] - there[0])) / length(cross(here[1] - here[0], here[2] - here[0]));
}

MappingCheck check(World w, Start s) {
    MappingCheck c;
    c.outcome = MAPPING_TRIED;
    uvec3 corners = cornersOf(w, s.primitive);
    c.uv = uvOn(w, corners, s.barycentrics, 0);
    c.position = c.image = restPosition(w, s.primitive, s.barycentrics);
    c.area = s.area;
    c.thickness = thickness(w, s.primitive, c.uv);
    c.edge = min(min(s.barycentrics.x, s.barycentrics.y), 1 - s.barycentrics.x - s.barycentrics.y);
    c.stretch = c.errorJacobian = c.errorReturn = c.finiteDifference = 0;
    UvFound here = uvLookup(w, uv(), s.mesh, s.from, c.uv), there = uvLookup(w, uv(), s.mesh, s.to, c.uv);
    c.here = here.count;
    c.there = there.count;
    for (uint i = 0; i < here.count; ++i)
        if (here.primitives[i] == s.primitive) c.outcome |= MAPPING_HELD;

    MappedPoint image = mapPoint(w, uv(), s.mesh, s.primitive, c.uv, s.from, s.to, params.matching);
    if (!(image.jacobian > 0)) return c;
    c.outcome |= MAPPING_THERE;
    c.thickness = min(c.thickness, thickness(w, image.primitive, c.uv));
    c.image = restPosition(w, image.primitive, image.barycentrics);
    c.stretch = image.jacobian * twiceArea(w, image.primitive) / twiceArea(w, s.primitive);
    if (passesNearer(w, there, c.position, image)) c.outcome |= MAPPING_PASSED;
    c.finiteDifference = finiteDifference(w, s, c.uv, image);

    MappedPoint back = mapPoint(w, uv(), s.mesh, image.primitive, c.uv, s.to, s.from, params.matching);
    if (!(back.jacobian > 0)) return c;
    c.outcome |= MAPPING_BACK | (back.primitive == s.primitive ? MAPPING_SAME : 0);
    c.errorJacobian = abs(image.jacobian * back.jacobian - 1);
    c.errorReturn = distance(c.position, restPosition(w, back.primitive, back.barycentrics)) / w.meshes.at[s.mesh].radius;
    return c;
}

vec3 colorOf(MappingCheck c) {
    if ((c.outcome & MAPPING_THERE) == 0) return (c.outcome & MAPPING_HELD) == 0 && c.here > 0 ? vec3(0.2) : vec3(1, 0, 0);
    if ((c.outcome & MAPPING_SAME) == 0) return vec3(1, 0, 1);
    if (c.errorReturn > 0.01 * params.tolerance) return vec3(1, 0.4, 0);
    bool different = c.finiteDifference > 0 && abs(c.finiteDifference / c.stretch - 1) > params.tolerance;
    if (different || c.errorJacobian > params.tolerance) return vec3(1, 1, 0);
    return (c.outcome & MAPPING_PASSED) != 0 ? vec3(0, 0.2, 1) : vec3(0, 0.25, 0);
}

void main() {
    if (skip()) return;
    ivec2 p = pixel();
    Start start;
    MappingCheck c = MappingCheck(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, vec2(0), vec3(0), vec3(0));
    World w = world();
    bool begun = begin(w, p, start);
    if (begun) c = check(w, start);
    storeChecks(pixelIndex(p), c);
    storeColor(p, vec4(begun ? colorOf(c) : vec3(0), 1));
}
