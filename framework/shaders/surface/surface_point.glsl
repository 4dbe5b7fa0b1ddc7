// SPDX-License-Identifier: MIT
// A point of a surface as paths keep it: by what carries it, not by where it lies, so that it stays the same point while things move, and can be asked
// in any World. Whoever has to know where it is, or how it connects, asks here; what else may carry points some day is added here.
#include "base/pack.glsl"
#include "surface/rounding.glsl"
#include "world/primary_hit.h"
#include "world/ray.h"
#include "world/triangle.glsl"

struct SurfacePoint {
    uint instance;
    uint primitive;     // World.primitives index, NONE: no surface
    vec2 barycentrics;  // of the second and third vertex
};

SurfacePoint pointOf(Hit h) { return SurfacePoint(h.instance, h.primitive, h.barycentrics); }
SurfacePoint pointOf(PrimaryHit h) { return SurfacePoint(h.instance, h.primitive, h.barycentrics); }

/// World-space position. With last frame's World it is the previous one.
vec3 positionAt(World w, SurfacePoint p) { return placePoint(placementOf(w, p.instance), pointOn(w, cornersOf(w, p.primitive), p.barycentrics).position); }

/// Texture coordinates of set 0.
vec2 uvAt(World w, SurfacePoint p) { return uvOn(w, cornersOf(w, p.primitive), p.barycentrics, 0u); }

/// The normal between the corners', in object space, not unit.
vec3 smoothNormalOn(World w, uvec3 corners, vec2 barycentrics) {
    vec3 weights = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics), n = vec3(0.0);
    for (int i = 0; i < 3; ++i) n += weights[i] * unpackNormal(w.vertices.at[corners[i]].normal);
    return n;
}

/// Does this World show the point, at the level at which the instance is present?
bool isShown(World w, SurfacePoint p) {
    uint shown = w.levels.at[p.instance], level = w.instances.at[p.instance].mesh * LEVELS + min(shown, LEVELS - 1u);
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
    TrianglePoint point = pointOn(w, cornersOf(w, p.primitive), p.barycentrics);
    vec3 position = placePoint(placement, point.position);
    gap = segmentGap(w, p.instance, placement, point, placeNormal(placement, cross(point.edge1, point.edge2)), position, position - from);
    return position;
}
