// SPDX-License-Identifier: MIT
// Where a reservoir's path begins, and the texture coordinates by which its vertices are found on other levels: travels with Reservoir.
#ifndef LODESTIR_SAMPLE_HIT_H
#define LODESTIR_SAMPLE_HIT_H
#include "base/shared.h"
#include "world/primary_hit.h"

LODESTIR_SHARED_BEGIN

/// Where a vertex lies on its triangle. Raw texture coordinates, not wrapped. A shift keeps them and never computes them anew from a hit, so that
/// the map between levels finds the same candidates there and back.
struct TrianglePlace {
    vec2 barycentrics;  // of the second and third vertex; of a point of the environment found by light sampling: place inside its texel
    vec2 uv;
};

struct SampleHit {
    PrimaryHit hit;    // x1, with the film and lens sample that lead to it (Zhang et al. 2024, Area ReSTIR)
    float time;        // within the exposure, [0,1)
    vec2 uv;           // of x1, like TrianglePlace.uv
    TrianglePlace rc;  // of the reconnection vertex x_k
    uint light;        // number that chose the light (lightPoint), where light sampling found it
};

LODESTIR_SHARED_END
LODESTIR_SHARED(SampleHit, "restir/sample_hit.h")
#ifdef __cplusplus
static_assert(sizeof(lodestir::SampleHit) == 64);
#endif
#endif
