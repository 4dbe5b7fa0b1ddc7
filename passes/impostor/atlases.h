// SPDX-License-Identifier: MIT
// Atlases of colours: what meshes look like from many sides, their materials evaluated when they were baked. This is what impostors in games are made of,
// and what those that keep materials open are compared with. impostor_atlas makes them, and other passes take them by one wire.
#ifndef LODESTIR_ATLASES_H
#define LODESTIR_ATLASES_H
#include "base/shared.h"
#include "world/world.h"

LODESTIR_SHARED_BEGIN

// Which directions the views of an atlas look from (impostor/atlas_views.glsl).
const uint ATLAS_FULL = 0u;   // a grid over the octahedral map of the sphere
const uint ATLAS_HEMI = 1u;   // one over that of the upper hemisphere
const uint ATLAS_CROSS = 2u;  // three cards at right angles to the axes, from both sides
const uint ATLAS_STAR = 3u;   // three upright cards 60 degrees apart and a level one, from both sides

// The atlas of a mesh. Texel (x, y) of a view at a level is element atlasIndex() of the arrays (impostor/atlas_views.glsl); impostor/atlas_texel.glsl says
// what their bits mean.
struct AtlasRecord {
    uint64_t shades;   // uvec2[]: base colour and alpha, normal
    uint64_t matters;  // uvec2[]: depth, roughness and metallic, emission; nothing where the atlas doesn't keep them
    vec3 center;       // of the sphere that the views stand around, object space
    float radius;      // 0: the mesh was not baked, and the addresses are nothing
};

LODESTIR_ARRAY(AtlasArray, AtlasRecord)

struct Atlases {
    LODESTIR_ARRAY_OF(AtlasArray) objects;  // of each mesh of the scene
    uint meshes;
    uint arrangement;  // ATLAS_*
    uint across;       // views a side of the grid; of cards: views
    uint resolution;   // texels a side of a view at the finest level, a power of 2
    uint levels;       // the coarsest has 8 texels a side
    uint isMatched;    // 1: `matters` are kept, 0: they are the same everywhere (UNKNOWN_* in impostor/atlas_texel.glsl)
};

LODESTIR_SHARED_END
LODESTIR_SHARED(Atlases, "impostor/atlases.h")
#endif
