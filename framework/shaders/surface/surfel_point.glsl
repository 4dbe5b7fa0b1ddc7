// SPDX-License-Identifier: MIT
// What a pixel shows of an impostor as a point that paths can keep.
#include "impostor/surfel.h"
#include "surface/surface_point.glsl"

/// The point of a surfel's texel, on its plane, that is nearest to `seen`, where the pixel's ray is at the surfel's depth; world space. Pixels that were
/// filled (hole_fill) have a texel beside them, and a place beyond its border.
SurfacePoint surfelPoint(World w, Surfel f, vec3 seen) {
    SurfacePoint p = SurfacePoint(f.instance, TEXEL | f.texel, vec2(0.0));
    Placement placement = placementOf(w, p.instance);
    TrianglePoint t = pointOf(w, p);
    vec3 away = seen - placePoint(placement, t.position), along = placeVector(placement, t.edge1), across = placeVector(placement, t.edge2);
    vec3 normal = cross(along, across);
    p.barycentrics = vec2(dot(cross(away, across), normal), dot(cross(along, away), normal)) / max(dot(normal, normal), 1e-30);
    return p;
}
