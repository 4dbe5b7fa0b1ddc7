// SPDX-License-Identifier: MIT
// What the shaders of a bake work on.
#ifndef LODESTIR_BAKE_JOB_H
#define LODESTIR_BAKE_JOB_H
#include "impostor/impostors.h"

LODESTIR_SHARED_BEGIN

// One mesh that is baked.
struct BakeJob {
    uint64_t objects;   // the World of Frame::objects()
    uint64_t numbers;   // uint[]: of each material of the scene, its number among the mesh's
    Impostors texels;   // where they are made: as they are, before they are compressed
    uint mesh;
    uint pad;
};

LODESTIR_SHARED_END
#endif
