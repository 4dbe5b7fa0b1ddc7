// SPDX-License-Identifier: MIT
// One invocation an instance.
#version 460
#include "pass.glsl"
#include "lod/depth_level.glsl"
#include "lod/total_error.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint at[]; };

/// Adds to a number of 64 bits: the sum of the low words runs over in one of the additions only.
void countTriangles(uint n) {
    if (addTriangles(0, n) > 0xffffffffu - n) addTriangles(1, 1);
}
void countBytes(uint n) {
    if (addBytes(0, n) > 0xffffffffu - n) addBytes(1, 1);
}

void main() {
    if (skip()) return;
    uint instance = uint(pixel().x);
    World w = madeWorld();
    Words levels = Words(uint64_t(w.levels)), levelsChanged = Words(uint64_t(w.levelsChanged));
    bool known = historyValid() && worldPrev().instanceCount == w.instanceCount;
    uint last = known ? worldPrev().levels.at[instance] : 0, mesh = w.instances.at[instance].mesh;
    uint level = levels.at[instance];
    uint chooses = level == NONE ? argument(0) : uint(mode_schedule);  // what is given is as if a schedule had it
    if (chooses == uint(mode_fixed)) level = min(uint(params.level), w.meshes.at[mesh].levels - 1u);
    if (chooses == uint(mode_distance)) level = levelByDistance(w, instance, params.distance, known, last, params.hysteresis);
    if (chooses == uint(mode_screen_error)) level = levelByError(w, instance, uintBitsToFloat(argument(1)), known, last, params.hysteresis);
    if (chooses == uint(mode_total_error))
        level = levelByTotalError(w, instance, TotalError(params.edges, params.samples, params.doubling), known, last, params.hysteresis);
    uint dissolve = 0;
    if (chooses == uint(mode_depth) || chooses == uint(mode_stochastic)) {
        // What glows shows all rays the same level, half way as with depth: lights are those of one level.
        bool dissolves = chooses == uint(mode_stochastic) && w.instances.at[instance].firstLight == NONE;
        DepthCurve curve = DepthCurve(params.curve == curve_log, w.sceneRadius * params.depthNear, w.sceneRadius * params.depthFar, params.bias);
        LevelShare between = levelShare(levelByDepth(w, instance, curve), w.meshes.at[mesh].levels, dissolves ? params.transition : 0, uint(params.steps));
        level = between.level;
        if (dissolves) dissolve = dissolveOf(between, uint(params.steps), params.numbers == numbers_each);
    }
    bool same = known && level == last;
    if (argument(0) == uint(mode_stochastic)) {
        same = same && uint64_t(worldPrev().dissolves) != 0ul && worldPrev().dissolves.at[instance] == dissolve;
        Words(uint64_t(w.dissolves)).at[instance] = dissolve;
    }
    levels.at[instance] = level;
    if (instance < chosenCount()) storeChosen(instance, level);
    if (!same) atomicOr(levelsChanged.at[0], 1);
    if (known && level != last && instance < changedCount()) storeChanged(instance, frameIndex() + 1);

    if ((w.instances.at[instance].flags & INSTANCE_HIDDEN) != 0u) return;
    uint place = mesh * LEVELS + min(level, w.meshes.at[mesh].levels - 1u);  // levels that aren't there are the coarsest
    LevelRecord record = w.meshLevels.at[place];
    countTriangles(record.primitiveCount);
    if (addShown(place, 1) == 0) countBytes(record.bytes);
}
