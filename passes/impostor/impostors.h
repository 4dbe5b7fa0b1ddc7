// SPDX-License-Identifier: MIT
// Reshadable impostors: orthographic views of a mesh that keep geometry, texture coordinates and material ids, never what a material looks like
// (Reshadable Impostors with Level-of-Detail for Real-Time Distant Objects Rendering; cited as RiLoD). impostor_bake makes them, and other passes take
// them by one wire.
#ifndef LODESTIR_IMPOSTORS_H
#define LODESTIR_IMPOSTORS_H
#include "base/shared.h"
#include "world/world.h"

LODESTIR_SHARED_BEGIN

const uint PALETTE = 8u;  // materials that levels above the finest tell apart: a nibble of 32 bits counts each

// The impostor of a mesh. Texel (x, y) of a view at a level is element texelIndex() of the arrays (impostor/views.glsl); impostor/texel.glsl says
// what their bits mean.
struct ImpostorRecord {
    uint64_t geometry;   // uvec4[]: normal, depth, length of the normal with density and flags, alpha
    uint64_t uvs;        // uint[]
    uint64_t materials;  // uint[]: index in World.materials at the finest level, counts of the palette above
    uint64_t places;     // uint[]: place in the palette of each material of the scene
    uint64_t tiles;      // TileRecord[], of each tile of 8x8 texels (element tileIndex()): what lets it be passed over
    vec3 center;         // of the sphere that the views stand around, object space
    float radius;        // 0: the mesh was not baked, and the addresses are nothing
    uvec2 pad;
    uint palette[PALETTE];  // indices in World.materials, NONE: free
};

LODESTIR_ARRAY(ImpostorArray, ImpostorRecord)

// A cone around the normals of a tile, and its range of depths.
struct TileRecord {
    uint axis;       // unit, in the view's axes (packNormal)
    float cosine;    // of the angle between the axis and the normal farthest off; -1: they tell nothing about what is seen
    float nearest;   // depths; of a tile that shows nothing the nearest is beyond the farthest
    float farthest;
};

LODESTIR_ARRAY(TileArray, TileRecord)

struct Impostors {
    LODESTIR_ARRAY_OF(ImpostorArray) objects;  // of each mesh of the scene
    uint meshes;
    uint views;       // 6, 12 or 18
    uint resolution;  // texels a side of a view at the finest level, a power of 2
    uint levels;      // of the pyramid; the coarsest has 4 texels a side
};

LODESTIR_SHARED_END
LODESTIR_SHARED(Impostors, "impostor/impostors.h")
#endif
