// SPDX-License-Identifier: MIT
// What follows the reconnection vertex, by the parameter of the pass (suffix.h). After pass.glsl.
#include "restir/pixel_levels.glsl"
#include "world/same_scene.glsl"

/// Is it walked anew where a path goes between `now` and `last`?
bool walksSuffix(World now, World last) {
    return params.suffix == suffix_walked || (params.suffix == suffix_automatic && (differInLevels(rules()) || !sameScene(now, last)));
}
