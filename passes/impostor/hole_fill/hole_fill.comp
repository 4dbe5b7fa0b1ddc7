// SPDX-License-Identifier: MIT
// Stage 2, by depth alone (RiLoD, section 3.4, after the thin features of FidelityFX Super Resolution 2.2.1): a pixel whose like neighbours fill no square of four
// is part of something thin; between two such, at most two pixels apart, it is continued. A pixel with like surfaces on five of its eight sides, all nearer
// than what it shows, is part of a crack and is closed.
#version 460
#include "pass.glsl"
#include "neighbour.glsl"

const ivec2 AROUND[8] = ivec2[](ivec2(1, 0), ivec2(1, 1), ivec2(0, 1), ivec2(-1, 1), ivec2(-1, 0), ivec2(-1, -1), ivec2(0, -1), ivec2(1, -1));

Neighbour at(World w, ivec2 p) {
    bool isInside = all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, ivec2(frameSize())));
    Surfel f = Surfel(NONE, 0.0, 0u, 0u, 0u, NONE, 0.0, NONE);
    if (isInside) f = blocks(pixelIndex(p));
    return neighbourOf(w, p, f);
}

/// Bit i: the neighbour AROUND[i] is of the same surface.
uint likeNeighbours(World w, ivec2 p, Neighbour own) {
    uint like = 0u;
    for (int i = 0; i < 8; ++i) like |= isSame(own, at(w, p + AROUND[i])) ? 1u << i : 0u;
    return like;
}

/// Nearer than all that is unlike it, and no square of four pixels is all of it.
bool isThin(World w, ivec2 p, Neighbour own) {
    if (!own.isThere) return false;
    uint like = likeNeighbours(w, p, own);
    for (int corner = 1; corner < 8; corner += 2) {
        uint square = 1u << (corner - 1) | 1u << corner | 1u << ((corner + 1) & 7);
        if ((like & square) == square) return false;
    }
    for (int i = 0; i < 8; ++i) {
        Neighbour n = at(w, p + AROUND[i]);
        if ((like & 1u << i) == 0u && n.isThere && n.f.depth < own.f.depth) return false;
    }
    return true;
}

/// A surfel between two that are one surface.
Surfel between(Neighbour a, Neighbour b, float share) {
    Surfel f = a.f;
    if (share > 0.5) f = b.f;
    f.depth = mix(a.f.depth, b.f.depth, share);
    f.normal = packNormal(safeNormalize(mix(a.normal, b.normal, share), a.normal));
    return f;
}

bool continues(World w, ivec2 p, Neighbour own, out Surfel made) {
    for (int i = 0; i < 4; ++i) {
        for (int split = 2; split <= 4; ++split) {  // one pixel apart on both sides, or one and two
            ivec2 to = AROUND[i] * (split / 2), from = -AROUND[i] * ((split + 1) / 2);
            if (split == 4) {
                to = AROUND[i] * 2;
                from = -AROUND[i];
            }
            Neighbour a = at(w, p + to), b = at(w, p + from);
            if (!isSame(a, b) || dot(a.normal, b.normal) < 0.5 || (own.isThere && own.f.depth < min(a.f.depth, b.f.depth))) continue;
            if (!isThin(w, p + to, a) || !isThin(w, p + from, b)) continue;
            float reach = length(vec2(to)), other = length(vec2(from));
            made = between(a, b, reach / (reach + other));
            return true;
        }
    }
    return false;
}

bool closes(World w, ivec2 p, Neighbour own, out Surfel made) {
    Neighbour nearest;
    nearest.isThere = false;
    for (int i = 0; i < 8; ++i) {
        Neighbour n = at(w, p + AROUND[i]);
        if (n.isThere && (!nearest.isThere || n.f.depth < nearest.f.depth)) nearest = n;
    }
    if (!nearest.isThere || (own.isThere && (isSame(own, nearest) || own.f.depth < nearest.f.depth))) return false;
    uint like = 0u;
    float depths = 0.0;
    vec3 normals = vec3(0.0);
    Ray ray = pixelRay(w, p);
    for (int i = 0; i < 8; ++i) {
        Neighbour n = at(w, p + AROUND[i]);
        if (!isSame(nearest, n) && !(n.isThere && n.f.depth == nearest.f.depth)) continue;
        ++like;
        depths += planeDepth(w, n, ray, 4.0);
        normals += n.normal;
    }
    if (like < 5u) return false;
    made = nearest.f;
    made.depth = depths / float(like);
    made.normal = packNormal(safeNormalize(normals, nearest.normal));
    return true;
}

void main() {
    if (skip()) return;
    ivec2 p = pixel();
    Surfel made = blocks(pixelIndex(p)), other;
    if (params.stage2) {
        World w = world();
        Neighbour own = neighbourOf(w, p, made);
        if (closes(w, p, own, other) || continues(w, p, own, other)) {
            made = other;
            storeFilled(p, 2.0);
        }
    }
    storeSurfels(pixelIndex(p), made);
}
