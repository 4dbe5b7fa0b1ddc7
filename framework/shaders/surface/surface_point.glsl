// SPDX-License-Identifier: MIT
// A point of a surface as paths keep it: by what carries it, not by where it lies, so that it stays the same point while things move, and can be asked
// in any World. Whoever has to know where it is, or how it connects, asks here; what else may carry points some day is added here.
//
// A texel of an impostor carries points as a triangle does, with its middle for the first corner and the middles of its right and its upper border for the
// others. It stands for all levels of its mesh.
#include "base/pack.glsl"
#include "surface/rounding.glsl"
#include "world/primary_hit.h"
#include "world/ray.h"
#include "world/ray_levels.glsl"
#include "world/scene_facts.glsl"
#include "world/triangle.glsl"
#if TEXEL_SURFACES
#include "impostor/texel_between.glsl"
#endif

struct SurfacePoint {
    uint instance;
    uint primitive;     // World.primitives index, or TEXEL + a texel's; NONE: no surface
    vec2 barycentrics;  // of the second and third vertex; of a texel from -1 to 1, and beyond where a hole was filled from it
};

bool isTexel(uint primitive) { return TEXEL_SURFACES != 0 && primitive >= TEXEL; }

SurfacePoint pointOf(Hit h) { return SurfacePoint(h.instance, h.primitive, h.barycentrics); }
SurfacePoint pointOf(PrimaryHit h) { return SurfacePoint(h.instance, h.primitive, h.barycentrics); }

/// In object space.
TrianglePoint pointOf(World w, SurfacePoint p) {
#if TEXEL_SURFACES
    if (isTexel(p.primitive)) return pointOn(impostorsOf(w), w.instances.at[p.instance].mesh, p.primitive - TEXEL, p.barycentrics);
#endif
    return pointOn(w, cornersOf(w, p.primitive), p.barycentrics);
}

/// World-space position. With last frame's World it is the previous one.
vec3 positionAt(World w, SurfacePoint p) { return placePoint(placementOf(w, p.instance), pointOf(w, p).position); }

/// Texture coordinates of set 0.
vec2 uvAt(World w, SurfacePoint p) {
#if TEXEL_SURFACES
    if (isTexel(p.primitive)) {
        Impostors made = impostorsOf(w);
        uint mesh = w.instances.at[p.instance].mesh;
        TexelPlace x = texelPlace(made, p.primitive - TEXEL);
        return texelBetween(made, mesh, x, texelAt(made, mesh, x.level, x.view, x.texel), p.barycentrics).uv;
    }
#endif
    return uvOn(w, cornersOf(w, p.primitive), p.barycentrics, 0u);
}

/// The normal between the corners', in object space, not unit.
vec3 smoothNormalOn(World w, uvec3 corners, vec2 barycentrics) {
    vec3 weights = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics), n = vec3(0.0);
    for (int i = 0; i < 3; ++i) n += weights[i] * unpackNormal(w.vertices.at[corners[i]].normal);
    return n;
}

/// The direction of the smooth normal at a point, in world space, unit; of either side.
vec3 smoothNormalAt(World w, SurfacePoint p) {
    Placement placement = placementOf(w, p.instance);
    vec3 n;
#if TEXEL_SURFACES
    if (isTexel(p.primitive)) {
        Impostors made = impostorsOf(w);
        TexelPlace x = texelPlace(made, p.primitive - TEXEL);
        n = outOfView(impostorView(made.views, x.view), shapeAt(made, w.instances.at[p.instance].mesh, x.level, x.view, x.texel).normal);
    } else
#endif
        n = smoothNormalOn(w, cornersOf(w, p.primitive), p.barycentrics);
    return safeNormalize(placeNormal(placement, n), vec3(0.0, 1.0, 0.0));
}

/// Does this World show the point to rays of a number (world/ray_levels.glsl), at the level at which the instance is present to them?
bool isShown(World w, SurfacePoint p, uint number) {
    if (isTexel(p.primitive)) return true;
    uint shown = levelSeen(w, p.instance, number), level = w.instances.at[p.instance].mesh * LEVELS + min(shown, LEVELS - 1u);
    return shown < LEVELS && p.primitive - w.meshLevels.at[level].firstPrimitive < w.meshLevels.at[level].primitiveCount;
}

// Of where a segment ends and where a ray along it meets something there, relative to its length and at right angles to what is met: the terms
// of rounding.glsl with s as long as the segment, for triangles of any but the sharpest angles.
const float SEGMENT_ROUNDING = 32.0 * ROUNDING;

/// How far before `position`, a point of a triangle, a segment that comes to it by `way` has to end, so that the triangle doesn't hide itself; world units.
/// `perpendicular`: of the triangle, as long as twice its area.
float segmentGap(World w, uint instance, Placement placement, TrianglePoint point, vec3 perpendicular, vec3 position, vec3 way) {
    float twiceArea = max(length(perpendicular), 1e-30), reach = length(way);
    float cosine = abs(dot(perpendicular, way)) / max(twiceArea * reach, 1e-30);
    return (2.0 * planeRounding(w, instance, placement, point, position, perpendicular / twiceArea, twiceArea) + SEGMENT_ROUNDING * reach) / max(cosine, 1e-6);
}

/// World-space position of a point that a segment from `from` is to end at, and how far before.
vec3 segmentEnd(World w, SurfacePoint p, vec3 from, out float gap) {
    Placement placement = placementOf(w, p.instance);
    TrianglePoint point = pointOf(w, p);
    vec3 position = placePoint(placement, point.position), perpendicular = placeNormal(placement, cross(point.edge1, point.edge2));
#if TEXEL_SURFACES
    if (isTexel(p.primitive)) {
        float side = 2.0 * sqrt(length(perpendicular)), cosine = abs(dot(safeNormalize(perpendicular, vec3(0.0)), safeNormalize(position - from, vec3(0.0))));
        gap = 2.0 * texelRounding(w, p.instance, placement, side) / max(cosine, 0.01);
        return position;
    }
#endif
    gap = segmentGap(w, p.instance, placement, point, perpendicular, position, position - from);
    return position;
}
