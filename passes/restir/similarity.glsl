// SPDX-License-Identifier: MIT
// Whether two pixels look at surfaces alike enough to reuse each other's paths. Only camera hits through pixel centres are asked, never
// samples: which neighbours count must not depend on what they hold.
#include "base/math.glsl"
#include "surface/surface_point.glsl"

/// What a pixel sees, as far as that question goes.
struct PixelView {
    bool sky;      // nothing was hit
    vec3 normal;   // smooth, towards the camera
    float depth;   // along the view direction
};

PixelView pixelView(World w, PrimaryHit h) {
    PixelView v = PixelView(true, vec3(0.0), 0.0);
    if (h.primitive == NONE) return v;
    vec3 way = positionAt(w, pointOf(h)) - w.camera.position, n = smoothNormalAt(w, pointOf(h));
    vec3 view = w.camera.orthographic != 0u ? w.camera.forward : way;
    return PixelView(false, dot(n, view) > 0.0 ? -n : n, dot(way, w.camera.forward));
}

/// Symmetric in a and b. `cosine`: least cosine of the angle between the normals; `depth`: most difference of depths, relative to the larger.
bool similarViews(PixelView a, PixelView b, float cosine, float depth) {
    if (a.sky || b.sky) return a.sky && b.sky;
    return dot(a.normal, b.normal) >= cosine && abs(a.depth - b.depth) <= depth * max(a.depth, b.depth);
}
