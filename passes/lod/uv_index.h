// SPDX-License-Identifier: MIT
// Finds the triangles of a mesh level by texture coordinates: a binary tree of boxes in the plane of UV set 0.
#ifndef LODESTIR_UV_INDEX_H
#define LODESTIR_UV_INDEX_H
#include "base/shared.h"
#include "world/world.h"

LODESTIR_SHARED_BEGIN

// A box in UV. Inner node: its children are nodes first and first + 1; leaf: triangles first, first + 1, ... of UvIndex.primitives.
struct UvNode {
    vec2 low, high;
    uint first;
    uint count;  // triangles of a leaf; 0: inner node
    uvec2 pad;
};

LODESTIR_ARRAY(UvNodeArray, UvNode)

struct UvIndex {
    LODESTIR_ARRAY_OF(UvNodeArray) nodes;
    LODESTIR_ARRAY_OF(UintArray) primitives;  // World.primitives indices, those of a leaf in a row
    LODESTIR_ARRAY_OF(UintArray) roots;       // node of mesh m at level l: roots[m * LEVELS + l]; NONE: no texture coordinates, or one level only
};

LODESTIR_SHARED_END
LODESTIR_SHARED(UvIndex, "lod/uv_index.h")
#endif
