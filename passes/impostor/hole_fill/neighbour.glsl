// SPDX-License-Identifier: MIT
// A pixel's surfel with where it is, and when two of them are of one surface. After pass.glsl.
#include "base/pack.glsl"
#include "impostor/surfel.h"
#include "world/camera.glsl"

/// Widths of a pixel that surfaces of one kind may lie off each other's planes.
const float SAME_SURFACE = 2.0;

struct Neighbour {
    bool isThere;
    Surfel f;
    vec3 position, normal;
    float width;  // of a pixel at its depth
};

Ray pixelRay(World w, ivec2 p) { return cameraRay(w, filmOf(p, vec2(0.5), frameSize()), LENS_CENTRE); }

const Surfel NOTHING = Surfel(NONE, 0.0, 0u, 0u, 0u, NONE, 0.0, NONE);

float widthAt(World w, float depth) { return w.camera.orthographic != 0u ? w.camera.pixelAngle : depth * w.camera.pixelAngle; }

/// Does it share its pixels with geometry? Then nothing is missing around it, and it fills nothing.
bool fades(Surfel f) { return f.instance != NONE && (f.measures >> 24 & SURFEL_FADES) != 0u; }

Neighbour neighbourOf(World w, ivec2 p, Surfel f) {
    Neighbour n;
    n.f = f;
    n.isThere = f.instance != NONE && !fades(f);
    if (!n.isThere) return n;
    Ray ray = pixelRay(w, p);
    n.position = ray.origin + f.depth / dot(ray.direction, w.camera.forward) * ray.direction;
    n.normal = unpackNormal(f.normal);
    n.width = widthAt(w, f.depth);
    return n;
}

/// Distance of a point from the plane of a surfel, in pixels' widths.
float offPlane(Neighbour n, vec3 point) { return abs(dot(n.normal, point - n.position)) / n.width; }

/// Does one lie on the other's plane? Of what bends at least one does.
bool isSame(Neighbour a, Neighbour b) {
    return a.isThere && b.isThere && a.f.instance == b.f.instance && min(offPlane(a, b.position), offPlane(b, a.position)) < SAME_SURFACE;
}

/// Depth at which a pixel's ray meets the plane of a surfel, no farther from its own than `most` pixels' widths.
float planeDepth(World w, Neighbour n, Ray ray, float most) {
    float along = dot(n.normal, ray.direction), forward = dot(ray.direction, w.camera.forward);
    float depth = abs(along) > 1e-3 ? dot(n.normal, n.position - ray.origin) / along * forward : n.f.depth;
    return clamp(depth, n.f.depth - most * n.width, n.f.depth + most * n.width);
}
