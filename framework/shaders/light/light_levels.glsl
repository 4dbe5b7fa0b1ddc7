// SPDX-License-Identifier: MIT
// Lights of instances that change their level.
//
// A number (LightRecord.last) chooses among the lights of all finest levels, so that an instance has the same numbers at each of its levels. At a coarser one
// its triangles share them, by their power there: behind the list that numbers choose from lie the lights of each of its coarser levels in a row. So a switch
// rebuilds nothing, and moves no number from one instance to another. A triangle of a level that isn't shown is no light.
#include "world/scene_facts.glsl"
#include "world/world.h"

/// Of which level an instance's lights are; of one that it doesn't have, or where it is hidden, of its coarsest.
uint levelOfLights(World w, uint instance) { return min(w.levels.at[instance], w.meshes.at[w.instances.at[instance].mesh].levels - 1u); }

/// The light between two that a number chooses, by bisection.
uint lightBetween(World w, uint number, uint light, uint end) {
    while (light < end) {
        uint middle = (light + end) / 2u;
        if (number > w.lights.at[middle].last) light = middle + 1u;
        else end = middle;
    }
    return light;
}

/// What a number chooses at the level shown, that at the finest chooses `light`. NONE: nothing glows at that level.
uint shownLight(World w, uint number, uint light) {
    if (SCENE_LIGHT_LEVELS == 0 || w.lights.at[light].type != LIGHT_TRIANGLE) return light;
    uint instance = w.lights.at[light].instance, coarser = w.instances.at[instance].coarserLights;
    uint level = coarser == NONE ? 0u : levelOfLights(w, instance);
    if (level == 0u) return light;
    uint first = w.lightLevels.at[coarser + level - 1u], end = w.lightLevels.at[coarser + level];
    return first < end ? lightBetween(w, number, first, end - 1u) : NONE;
}

/// The light that a triangle of an instance is. NONE: it doesn't glow, or is of a level that isn't shown.
uint triangleLight(World w, uint instance, uint primitive) {
    uint emitter = w.emitters.at[primitive], first = w.instances.at[instance].firstLight;
    if (emitter == NONE || first == NONE) return NONE;
    uint coarser = SCENE_LIGHT_LEVELS == 0 ? NONE : w.instances.at[instance].coarserLights;
    if (coarser != NONE) {
        uint level = levelOfLights(w, instance), shown = w.instances.at[instance].mesh * LEVELS + level;
        if (primitive - w.meshLevels.at[shown].firstPrimitive >= w.meshLevels.at[shown].primitiveCount) return NONE;
        if (level > 0u) first = w.lightLevels.at[coarser + level - 1u];
    }
    return first + emitter;
}
