// SPDX-License-Identifier: MIT
// Levels that are chosen pixel by pixel (world/ray_levels.glsl): what a path saw in one pixel may not be there for another.
#include "restir/rules.h"
#include "world/scene_facts.glsl"

/// Whether two pixels may see different levels of one instance. Where the number belongs to the path, it takes what it saw along.
bool differInLevels(ShiftRules rules) { return RAY_LEVELS != 0 && rules.pixelCamera != 0u; }
