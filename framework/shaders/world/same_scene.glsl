// SPDX-License-Identifier: MIT
// Whether two Worlds differ in nothing but their cameras. Memory that a later World shares with an earlier one holds the same things.
#include "world/world.h"

bool sameScene(World a, World b) {
    return uint64_t(a.instances) == uint64_t(b.instances) && uint64_t(a.levels) == uint64_t(b.levels) && uint64_t(a.lights) == uint64_t(b.lights) &&
           uint64_t(a.positions) == uint64_t(b.positions) && uint64_t(a.materials) == uint64_t(b.materials) &&
           uint64_t(a.environment) == uint64_t(b.environment) && a.environmentRotation == b.environmentRotation;
}
