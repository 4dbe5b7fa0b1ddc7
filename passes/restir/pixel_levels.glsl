// SPDX-License-Identifier: MIT
// Levels and times that are chosen pixel by pixel (world/ray_levels.glsl, world/exposure.glsl): what a path saw in one pixel may not be there for another.
#include "restir/rules.h"
#include "world/scene_facts.glsl"

/// Whether two pixels may see different levels of one instance, or see it elsewhere. Where the number belongs to the path, it takes what it saw along.
bool differInLevels(ShiftRules rules) { return RAY_NUMBERS && rules.pixelCamera != 0u; }
