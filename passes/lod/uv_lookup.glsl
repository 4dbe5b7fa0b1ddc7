// SPDX-License-Identifier: MIT
// All triangles of a mesh level that hold a given texture coordinate: a point query in the plane of UV set 0, alike on every device.
//
// What is found depends on (mesh, level, uv) alone, never on who asks, so that a map between levels finds the same there and back.
#include "lod/uv_index.h"
#include "world/triangle.glsl"

const uint UV_BUDGET = 8u;  // most triangles; a query that meets more fails, in both directions of a map

struct UvFound {
    uint count;                     // 0: none, or more than UV_BUDGET
    uint primitives[UV_BUDGET];     // rising
    vec2 barycentrics[UV_BUDGET];
};

const float UV_SLIVER = 8e-6;  // least height of a triangle in UV over its largest coordinate or edge: 64 steps of a float

/// Barycentrics of uv in the triangle with these corner coordinates; x < 0 where it lies outside or the triangle is so thin in UV that rounding
/// decides where in it a coordinate lies. Corners and edges are inside.
vec2 uvBarycentrics(vec2 a, vec2 b, vec2 c, vec2 uv) {
    vec2 e = b - a, f = c - a, p = uv - a;
    float area = e.x * f.y - e.y * f.x;
    float edge = max(length(e), length(f)), reach = max(max(abs(a.x), abs(a.y)), edge);
    if (abs(area) <= UV_SLIVER * reach * edge) return vec2(-1.0);
    vec2 found = vec2(p.x * f.y - p.y * f.x, e.x * p.y - e.y * p.x) / area;
    bool inside = found.x >= 0.0 && found.y >= 0.0 && found.x + found.y <= 1.0;
    return inside ? found : vec2(-1.0);
}

/// Enters a triangle, kept in rising order so that the walk through the tree leaves no trace.
void keepFound(inout UvFound f, uint primitive, vec2 barycentrics) {
    uint i = f.count++;
    for (; i > 0u && f.primitives[i - 1u] > primitive; --i) {
        f.primitives[i] = f.primitives[i - 1u];
        f.barycentrics[i] = f.barycentrics[i - 1u];
    }
    f.primitives[i] = primitive;
    f.barycentrics[i] = barycentrics;
}

/// Triangles of `mesh` at `level` that hold uv.
UvFound uvLookup(World w, UvIndex index, uint mesh, uint level, vec2 uv) {
    UvFound found;
    found.count = 0u;
    uint root = index.roots.at[mesh * LEVELS + level];
    if (root == NONE) return found;
    uint stack[32], depth = 0u;  // the builder keeps trees below that
    stack[depth++] = root;
    while (depth > 0u) {
        UvNode n = index.nodes.at[stack[--depth]];
        if (any(lessThan(uv, n.low)) || any(greaterThan(uv, n.high))) continue;
        if (n.count == 0u) {
            stack[depth++] = n.first;
            stack[depth++] = n.first + 1u;
            continue;
        }
        for (uint i = 0u; i < n.count; ++i) {
            uint primitive = index.primitives.at[n.first + i];
            uvec3 corners = cornersOf(w, primitive);
            vec2 at = uvBarycentrics(w.vertices.at[corners.x].uv0, w.vertices.at[corners.y].uv0, w.vertices.at[corners.z].uv0, uv);
            if (at.x < 0.0) continue;
            if (found.count == UV_BUDGET) {
                found.count = 0u;
                return found;
            }
            keepFound(found, primitive, at);
        }
    }
    return found;
}
