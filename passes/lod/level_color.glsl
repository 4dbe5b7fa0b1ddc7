// SPDX-License-Identifier: MIT
// The level that a triangle is of, and its colour.
#include "world/world.h"

/// Level of a mesh that a triangle, by its number in World.primitives, is of; NONE: of none, as texels of impostors are.
uint levelOf(World w, uint mesh, uint primitive) {
    for (uint level = 0; level < w.meshes.at[mesh].levels; ++level) {
        LevelRecord record = w.meshLevels.at[mesh * LEVELS + level];
        if (primitive - record.firstPrimitive < record.primitiveCount) return level;
    }
    return NONE;
}

/// From red, level 0, around the hues to blue, the last of `levels`; grey where there is no choice.
vec3 levelColor(uint level, uint levels) {
    if (level == NONE || levels < 2u) return vec3(0.5);
    float hue = 4.0 * float(level) / float(levels - 1u);  // in sixths of the circle: red 0, yellow 1, green 2, cyan 3, blue 4
    return clamp(vec3(abs(hue - 3.0) - 1.0, 2.0 - abs(hue - 2.0), 2.0 - abs(hue - 4.0)), 0.0, 1.0);
}
