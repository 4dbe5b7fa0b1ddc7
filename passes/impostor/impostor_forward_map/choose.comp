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

/// What an instance was drawn as last frame.
struct DrawnBefore {
    bool isKnown;
    uint level, before;  // the same where nothing fades
    uint frame;          // in which it passed from one to the other, modulo 2^16
};

DrawnBefore drawnBefore(uint instance) {
    uint bits = instance < levelsCount() && historyValid() ? levels(instance) : 0u;
    return DrawnBefore((bits & 0x100u) != 0u, bits & 15u, bits >> 4 & 15u, bits >> 16);
}

void remember(uint instance, DrawnBefore d) {
    if (instance < levelsCount()) storeLevels(instance, d.level | d.before << 4 | 0x100u | d.frame << 16);
}

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
uint heldLevel(float wish, DrawnBefore last, uint most) {
    float held = floor(wish);
    if (last.isKnown && last.level != NOT_DRAWN) {
        float before = float(last.level);
        if (wish > before - params.hysteresis && wish < before + 1.0 + params.hysteresis) held = before;
    }
    return uint(clamp(held, 0.0, float(most)));
}

// What only oblique views see is the smaller the smaller the object is, and what all of them draw is thicker than each: of a level as many cosines more.
const float FEWER = 0.2;
const float FEWEST = 0.57;  // below the cosine from a corner of the cube to the nearest of 6 views

/// A bit for each view that stands on the camera's side. `towards`: from the object to the camera, unit, world space.
uint keptViews(Impostors made, Placement placement, vec3 towards, uint level) {
    float limit = max(params.viewLimit, min(params.viewLimit + FEWER * float(level), FEWEST));
    uint views = 0u;
    for (uint view = 0u; view < made.views; ++view) {
        vec3 direction = normalize(placeVector(placement, viewDirection(made.views, view)));
        if (dot(direction, towards) >= limit) views |= 1u << view;
    }
    return views;
}

/// What others show of an instance: camera rays its geometry, where that isn't drawn here or still fades; all other rays, where it is drawn, a coarse level.
void showElsewhere(World w, uint instance, Drawn d, bool changes) {
    uint shown = w.levels.at[instance], coarsest = max(w.meshes.at[w.instances.at[instance].mesh].levels - 1u, shown);
    bool isDrawn = d.now.level != NOT_DRAWN, isSeen = !isDrawn || (d.share < 1.0 && d.before.level == NOT_DRAWN);
    Words(uint64_t(rest().levels)).at[instance] = isSeen ? shown : LEVELS;
    Words(uint64_t(madeWorld().levels)).at[instance] = isDrawn && shown < LEVELS ? min(shown + uint(params.coarser), coarsest) : shown;
    if (!changes) return;
    atomicOr(Words(uint64_t(rest().levelsChanged)).at[0], 1u);
    atomicOr(Words(uint64_t(madeWorld().levelsChanged)).at[0], 1u);
}

uint tilesOf(Impostors made, Drawn d) { return tilesOf(made, d.now) + tilesOf(made, d.before); }

/// The same, its levels coarser.
Drawn coarserBy(Impostors made, Drawn d, uint levels) {
    if (d.now.level != NOT_DRAWN) d.now.level = min(d.now.level + levels, made.levels - 1u);
    if (d.before.level != NOT_DRAWN) d.before.level = min(d.before.level + levels, made.levels - 1u);
    return d;
}

/// What an instance is drawn as in this frame. `kept`: what the next frame has to know.
Drawn choose(World w, Impostors made, uint instance, DrawnBefore last, out DrawnBefore kept) {
    InstanceRecord record = w.instances.at[instance];
    ImpostorRecord object = made.objects.at[record.mesh];
    Placement placement = placementOf(w, instance);
    float scale = placementScale(placement);
    vec3 way = w.camera.position - placePoint(placement, object.center);
    bool wasDrawn = last.isKnown && last.level != NOT_DRAWN;
    kept = DrawnBefore(true, NOT_DRAWN, NOT_DRAWN, frameIndex() & 0xffffu);
    if (object.radius > 0.0 && (record.flags & INSTANCE_HIDDEN) == 0u && isFineEnough(finestTexels(w, made, object.radius, scale, length(way)), wasDrawn))
        kept.level = heldLevel(wishedLevel(w, made, object.radius, scale, length(way)), last, made.levels - 1u);
    kept.before = last.isKnown ? last.level : kept.level;
    if (last.isKnown && last.before != last.level && kept.level == last.level) {  // it goes on
        kept.before = last.before;
        kept.frame = last.frame;
    }
    Drawn d = Drawn(DrawnLevel(kept.level, 0u), DrawnLevel(kept.before, 0u), 1.0);
    if (kept.before != kept.level) d.share = float(((frameIndex() - kept.frame) & 0xffffu) + 1u) / float(params.transition + 1);
    if (d.share >= 1.0) {
        d.before.level = NOT_DRAWN;
        kept.before = kept.level;
    }
    if (dot(-way, w.camera.forward) < -scale * object.radius) return d;  // behind the camera
    vec3 towards = w.camera.orthographic != 0u ? -w.camera.forward : safeNormalize(way, -w.camera.forward);
    if (d.now.level != NOT_DRAWN) d.now.views = keptViews(made, placement, towards, d.now.level);
    if (d.before.level != NOT_DRAWN) d.before.views = keptViews(made, placement, towards, d.before.level);
    return d;
}

void main() {
    if (skip()) return;
    uint instance = uint(pixel().x);
    World w = world();
    Impostors made = impostors();
    DrawnBefore last = drawnBefore(instance), kept;
    Drawn d = choose(w, made, instance, last, kept);
    Totals sums = Totals(passBlock().totals.address);
    if (argument(0) == 0u) {
        for (uint coarser = 0u; coarser < 8u; ++coarser) atomicAdd(sums.at[coarser], uint64_t(tilesOf(made, coarserBy(made, d, coarser))));
        return;
    }
    uint coarser = 0u;
    while (coarser < 7u && sums.at[coarser] > uint64_t(params.tiles)) ++coarser;
    bool changes = !last.isKnown || (kept.level == NOT_DRAWN) != (last.level == NOT_DRAWN) || (last.before != last.level && last.before == NOT_DRAWN);
    showElsewhere(w, instance, d, changes || (instance == 0u && w.levelsChanged.at[0] != 0u));
    remember(instance, kept);
    d = coarserBy(made, d, coarser);
    storeDrawn(instance, d);
    storeItems(instance, tilesOf(made, d));
}
