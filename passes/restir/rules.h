// SPDX-License-Identifier: MIT
// What every pass that shifts a path has to agree on, because it decides which vertices are connected and how light was found. The pass that
// makes the paths hands it on, so that it is set in one place.
#ifndef LODESTIR_SHIFT_RULES_H
#define LODESTIR_SHIFT_RULES_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

struct ShiftRules {
    uint criteria;         // CRITERIA_* (restir/criteria.glsl)
    float roughness;       // least perceptual roughness of the lobes on both sides of a connection, or before it
    float distance;        // least length of a connection, scene units
    float footprint;       // least footprint of a connection's directions, relative to primaryFootprint()
    float spread;          // relative deviation of that from path to path
    uint forcedNee;        // 1: a light found by light sampling is connected whatever roughness and distance say
    uint lightCandidates;  // lights that light sampling chooses from at x_1; at x_j a share of 1 / j^2, at least 1
    uint technique;        // TECHNIQUE_* (basic/light_technique.glsl)
    uint pixelCamera;      // 1: the camera sample (place inside the pixel and on the lens) is the pixel's; 0: it belongs to the path
};

LODESTIR_SHARED_END
LODESTIR_SHARED(ShiftRules, "restir/rules.h")
#endif
