// SPDX-License-Identifier: MIT
// Stage 2, by depth alone (RiLoD, section 3.4, after the thin features of FidelityFX Super Resolution 2.2.1): a pixel whose like neighbours fill no
// square of four is part of something thin; between two such, at most two pixels apart, it is continued. A pixel with like surfaces on five of its eight
// sides, all nearer than what it shows, is part of a crack and is closed.
#version 460
#include "pass.glsl"
#include "neighbour.glsl"

const ivec2 AROUND[8] = ivec2[](ivec2(1, 0), ivec2(1, 1), ivec2(0, 1), ivec2(-1, 1), ivec2(-1, 0), ivec2(-1, -1), ivec2(0, -1), ivec2(1, -1));

Neighbour at(World w, ivec2 p) {
    Surfel f = NOTHING;
    if (inside(p)) f = blocks(pixelIndex(p));
    return neighbourOf(w, p, f);
}

/// Is anything nearer beside the pixel than what it shows? Few pixels pass.
bool mayChange(World w, ivec2 p, Surfel own) {
    for (int i = 0; i < 8; ++i) {
        if (!inside(p + AROUND[i])) continue;
        Surfel f = blocks(pixelIndex(p + AROUND[i]));
        if (f.instance != NONE && (own.instance == NONE || own.depth - f.depth > SAME_SURFACE * widthAt(w, own.depth))) return true;
    }
    return false;
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
    const ivec2 gaps[3] = ivec2[](ivec2(1, 1), ivec2(1, 2), ivec2(2, 1));  // pixels to both ends
    for (int i = 0; i < 12; ++i) {
        ivec2 way = AROUND[i / 3], gap = gaps[i % 3], to = p + gap.x * way, from = p - gap.y * way;
        Neighbour a = at(w, to), b = at(w, from);
        if (!isSame(a, b) || dot(a.normal, b.normal) < 0.5 || (own.isThere && own.f.depth < min(a.f.depth, b.f.depth))) continue;
        if (!isThin(w, to, a) || !isThin(w, from, b)) continue;
        made = between(a, b, float(gap.x) / float(gap.x + gap.y));
        return true;
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
    World w = world();
    if (params.stage2 && !fades(made) && mayChange(w, p, made)) {
        Neighbour own = neighbourOf(w, p, made);
        if (closes(w, p, own, other) || continues(w, p, own, other)) {
            made = other;
            storeFilled(p, 2.0);
        }
    }
    storeSurfels(pixelIndex(p), made);
}
