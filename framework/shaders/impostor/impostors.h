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

// 4x4 texels of a compressed impostor, row after row. What an element says of 64 bits is a block of impostor/bc4.glsl, of texels that see something.
struct ShapeBlock {
    uvec2 normal[2];  // coordinates of the hemi-octahedral map in the view's axes, from [-1, 1] to [0, 1]
    uvec2 alpha;
    uvec2 spread;     // square root of what the normal's length lacks to 1, which is as fine as the widths of lobes are that lengths stand for
    uvec2 density;    // its code
    uvec2 flags;      // 4 bits each: no BC4 block
    uint depths[8];   // unorm16 x 2
};

LODESTIR_ARRAY(ShapeBlockArray, ShapeBlock)

// The impostor of a mesh. Texel (x, y) of a view at a level is element texelIndex() of the arrays, and texel blockTexel() of element blockIndex() of those
// of blocks (impostor/views.glsl); impostor/texel.glsl says what their bits mean.
struct ImpostorRecord {
    uint64_t shapes;     // uvec4[]: normal, depth, length of the normal with density and flags, alpha; or ShapeBlock[]
    uint64_t uvs;        // uint[]
    uint64_t materials;  // of the finest level: number among the mesh's, NONE where nothing is seen: uint[]; compressed: 16 bits each
    uint64_t counts;     // uint[]: shares of the palette's places, of the coarser levels, the first of which begins it
    uint64_t names;      // uint[]: of each material of the mesh, the largest first, index in World.materials and place in the palette
    uint64_t tiles;      // TileRecord[], of each tile of 8x8 texels (element tileIndex()): what lets it be passed over
    vec3 center;         // of the sphere that the views stand around, object space
    float radius;        // 0: the mesh was not baked, and the addresses are nothing
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
    uint compressed;  // 1: shapes are blocks
    uint pad;
};

LODESTIR_SHARED_END
LODESTIR_SHARED(Impostors, "impostor/impostors.h")
#endif
