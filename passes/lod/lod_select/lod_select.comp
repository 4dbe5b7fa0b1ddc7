// SPDX-License-Identifier: MIT
// One invocation an instance.
#version 460
#include "pass.glsl"
#include "lod/screen_error.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint at[]; };

void main() {
    if (skip()) return;
    uint instance = uint(pixel().x);
    World w = madeWorld();
    Words levels = Words(uint64_t(w.levels)), levelsChanged = Words(uint64_t(w.levelsChanged));
    bool known = historyValid() && worldPrev().instanceCount == w.instanceCount;
    uint last = known ? worldPrev().levels.at[instance] : 0;
    uint level = levels.at[instance];
    if (argument(0) == uint(mode_distance)) level = levelByDistance(w, instance, params.distance, known, last, params.hysteresis);
    if (argument(0) == uint(mode_screen_error)) level = levelByError(w, instance, uintBitsToFloat(argument(1)), known, last, params.hysteresis);
    levels.at[instance] = level;
    if (!known || level != last) atomicOr(levelsChanged.at[0], 1);
    if (known && level != last && instance < changedCount()) storeChanged(instance, frameIndex() + 1);
}
