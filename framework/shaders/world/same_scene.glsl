// SPDX-License-Identifier: MIT
// Whether two Worlds differ in nothing but their cameras. Memory that a later World shares with an earlier one holds the same things.
#include "world/world.h"

/// `now` is the World of a frame and `last` that of the frame before.
bool sameScene(World now, World last) {
    bool levels = uint64_t(now.levels) == uint64_t(last.levels) || now.levelsChanged.at[0] == 0u;
    return levels && uint64_t(now.instances) == uint64_t(last.instances) && uint64_t(now.lights) == uint64_t(last.lights) &&
           uint64_t(now.positions) == uint64_t(last.positions) && uint64_t(now.materials) == uint64_t(last.materials) &&
           uint64_t(now.environment) == uint64_t(last.environment) && now.environmentRotation == last.environmentRotation;
}
