// SPDX-License-Identifier: MIT
// tau: where a point of one level lies on another, by its texture coordinate (Real-Time Level-of-Detail Rendering with ReSTIR, Algorithm 1 and
// Eq. 6).
//
// Where several triangles share a coordinate, those of both levels are paired greedily by distance. Both directions see the same two sets, so
// the pairing is one and the same, and tau can be undone.
#include "lod/uv_lookup.glsl"

struct MappedPoint {
    uint primitive;
    vec2 barycentrics;
    float jacobian;  // barycentric area there per barycentric area here; 0: tau is not defined for this point
};

/// Area of the triangle in UV, twice.
float twiceUvArea(World w, uint primitive) {
    uvec3 corners = cornersOf(w, primitive);
    vec2 a = w.vertices.at[corners.x].uv0, e = w.vertices.at[corners.y].uv0 - a, f = w.vertices.at[corners.z].uv0 - a;
    return abs(e.x * f.y - e.y * f.x);
}

/// Position for comparing distances: object space, whatever the instance does.
vec3 restPosition(World w, uint primitive, vec2 barycentrics) { return pointOn(w, cornersOf(w, primitive), barycentrics).position; }

/// Partner of the triangle `primitive` among `to`; NONE: it has none. Algorithm 1: the closest pair of both sets is taken out again and
/// again; of equal distances the first pair in order of the finer level's triangles, then of the coarser one's.
/// Distances are those after `space`.
uint matchGreedily(World w, UvFound from, UvFound to, uint primitive, bool fromIsFiner, mat3 space) {
    vec3 fromAt[UV_BUDGET], toAt[UV_BUDGET];
    for (uint i = 0u; i < from.count; ++i) fromAt[i] = space * restPosition(w, from.primitives[i], from.barycentrics[i]);
    for (uint i = 0u; i < to.count; ++i) toAt[i] = space * restPosition(w, to.primitives[i], to.barycentrics[i]);
    uint takenFrom = 0u, takenTo = 0u;
    uint pairs = min(from.count, to.count);
    for (uint round = 0u; round < pairs; ++round) {
        float least = 3e38;
        uint bestFrom = 0u, bestTo = 0u;
        uint outer = fromIsFiner ? from.count : to.count, inner = fromIsFiner ? to.count : from.count;
        for (uint o = 0u; o < outer; ++o) {
            for (uint i = 0u; i < inner; ++i) {
                uint a = fromIsFiner ? o : i, b = fromIsFiner ? i : o;
                if ((takenFrom >> a & 1u) != 0u || (takenTo >> b & 1u) != 0u) continue;
                vec3 way = fromAt[a] - toAt[b];
                float squared = dot(way, way);
                if (squared >= least) continue;
                least = squared;
                bestFrom = a;
                bestTo = b;
            }
        }
        if (from.primitives[bestFrom] == primitive) return bestTo;
        takenFrom |= 1u << bestFrom;
        takenTo |= 1u << bestTo;
    }
    return NONE;
}

/// tau of a point of `mesh`: triangle `primitive` of level `from`, texture coordinate uv, to level `to`. `matching` false: only where both
/// levels have one triangle there. Both Worlds of a shift have the same meshes; w is either, of which a way there and back needs the same one, whose pose
/// it is where the mesh deforms. `space`: mat3(1) compares distances in the mesh's own space; a way there and back needs the same one.
MappedPoint mapPoint(World w, UvIndex index, uint mesh, uint primitive, vec2 uv, uint from, uint to, bool matching, mat3 space) {
    MappedPoint none = MappedPoint(NONE, vec2(0.0), 0.0);
    UvFound here, there;
    for (uint i = 0u; i < 2u; ++i) {  // one lookup in a loop compiles in half the time of two
        here = there;
        there = uvLookup(w, index, mesh, i == 0u ? from : to, uv);
    }
    if (here.count == 0u || there.count == 0u) return none;
    uint partner;
    if (matching) {
        partner = matchGreedily(w, here, there, primitive, from < to, space);
    } else {
        partner = here.count == 1u && there.count == 1u && here.primitives[0] == primitive ? 0u : NONE;
    }
    if (partner == NONE) return none;
    float areaHere = twiceUvArea(w, primitive), areaThere = twiceUvArea(w, there.primitives[partner]);
    return MappedPoint(there.primitives[partner], there.barycentrics[partner], areaHere / areaThere);
}

/// The same with distances in the mesh's own space.
MappedPoint mapPoint(World w, UvIndex index, uint mesh, uint primitive, vec2 uv, uint from, uint to, bool matching) {
    return mapPoint(w, index, mesh, primitive, uv, from, to, matching, mat3(1.0));
}
