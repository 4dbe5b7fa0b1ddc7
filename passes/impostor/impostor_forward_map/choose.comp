// SPDX-License-Identifier: MIT
// Which instances are drawn, at which level, and by which views. Argument 0: counts the tiles for all levels as they are wished and coarser by 1 to 7;
// 1: takes the first of these that the budget allows.
#version 460
#include "pass.glsl"
#include "base/math.glsl"
#include "impostor/texel_plane.glsl"
#include "numbering.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer Totals { uint64_t at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Words { uint at[]; };

// Distance over radius from 1 / (2 N) of which on nothing is drawn anyway.
const float NEAREST = 1e-3;

float nearSide(float radius, float scale, float distance) { return max(distance - scale * radius, NEAREST * scale * radius); }

/// log2 of finest texels per pixel, where the object is nearest.
float finestTexels(World w, Impostors made, float radius, float scale, float distance) {
    float pixel = w.camera.orthographic != 0u ? w.camera.pixelAngle : nearSide(radius, scale, distance) * w.camera.pixelAngle;
    return log2(pixel / (scale * texelSide(made, radius, 0u)));
}

float wishedLevel(World w, Impostors made, float radius, float scale, float distance) {
    if (params.level == level_fixed) return params.bias;
    if (params.level == level_distance) return log2(nearSide(radius, scale, distance) / (scale * radius)) + params.bias;
    return finestTexels(w, made, radius, scale, distance) - 0.25 + params.bias;  // a little finer than pixels, so that no pixel is left out
}

/// By the rule of lod_select, an impostor being a level whose error is the side of its texels.
bool isFineEnough(float texels, bool wasDrawn) {
    float least = -log2(max(params.pixelError, 1e-30));
    return params.pixelError == 0.0 || texels > least + (wasDrawn ? -params.hysteresis : params.hysteresis);
}

/// The wish rounded down, but the level of last frame as long as it isn't `hysteresis` beyond its borders.
uint heldLevel(float wish, uint last, uint most) {
    float held = floor(wish);
    if (last != 0u && historyValid()) {
        float before = float(last - 1u);
        if (wish > before - params.hysteresis && wish < before + 1.0 + params.hysteresis) held = before;
    }
    return uint(clamp(held, 0.0, float(most)));
}

/// A bit for each view that stands on the camera's side. `towards`: from the object to the camera, unit, world space.
uint keptViews(Impostors made, Placement placement, vec3 towards) {
    uint views = 0u;
    for (uint view = 0u; view < made.views; ++view) {
        vec3 direction = normalize(placeVector(placement, viewDirection(made.views, view)));
        if (dot(direction, towards) >= params.viewLimit) views |= 1u << view;
    }
    return views;
}

/// What others show of an instance: camera rays nothing of what is drawn here, all other rays a coarse level of its mesh.
void showElsewhere(World w, uint instance, bool isDrawn, bool changes) {
    uint shown = w.levels.at[instance], most = w.meshes.at[w.instances.at[instance].mesh].levels - 1u;
    Words(uint64_t(rest().levels)).at[instance] = isDrawn ? LEVELS : shown;
    Words(uint64_t(madeWorld().levels)).at[instance] = isDrawn && shown < LEVELS ? clamp(shown + uint(params.coarser), shown, max(most, shown)) : shown;
    if (!changes) return;
    atomicOr(Words(uint64_t(rest().levelsChanged)).at[0], 1u);
    atomicOr(Words(uint64_t(madeWorld().levelsChanged)).at[0], 1u);
}

void main() {
    if (skip()) return;
    uint instance = uint(pixel().x);
    World w = world();
    Impostors made = impostors();
    InstanceRecord record = w.instances.at[instance];
    ImpostorRecord object = made.objects.at[record.mesh];
    bool isDrawn = object.radius > 0.0 && (record.flags & INSTANCE_HIDDEN) == 0u;
    Placement placement = placementOf(w, instance);
    float scale = placementScale(placement);
    vec3 way = w.camera.position - placePoint(placement, object.center);
    if (dot(-way, w.camera.forward) < -scale * object.radius) isDrawn = false;

    bool isKnown = instance < levelsCount();
    uint last = isKnown ? levels(instance) : 0u;
    bool wasDrawn = last != 0u && historyValid();
    if (!isFineEnough(finestTexels(w, made, object.radius, scale, length(way)), wasDrawn)) isDrawn = false;
    uint level = heldLevel(wishedLevel(w, made, object.radius, scale, length(way)), last, made.levels - 1u);
    vec3 towards = w.camera.orthographic != 0u ? -w.camera.forward : safeNormalize(way, -w.camera.forward);
    uint views = isDrawn ? keptViews(made, placement, towards) : 0u;

    Totals sums = Totals(passBlock().totals.address);
    if (argument(0) == 0u) {
        for (uint coarser = 0u; coarser < 8u; ++coarser)
            atomicAdd(sums.at[coarser], uint64_t(bitCount(views) * tilesInView(made, min(level + coarser, made.levels - 1u))));
        return;
    }
    uint coarser = 0u;
    while (coarser < 7u && sums.at[coarser] > uint64_t(params.tiles)) ++coarser;
    if (isKnown) storeLevels(instance, isDrawn ? level + 1u : 0u);
    showElsewhere(w, instance, isDrawn, isDrawn != wasDrawn || !historyValid() || (instance == 0u && w.levelsChanged.at[0] != 0u));
    level = min(level + coarser, made.levels - 1u);
    storeDrawn(instance, Drawn(level, views));
    storeItems(instance, bitCount(views) * tilesInView(made, level));
}
