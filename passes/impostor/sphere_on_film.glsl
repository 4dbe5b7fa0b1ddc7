// SPDX-License-Identifier: MIT
// Where on the film a sphere may be seen.
#include "world/camera.glsl"

/// Along one axis of the film, whose half extent at distance 1 is `axis` long: the slopes of the two lines through the eye that touch the circle around (x, z)
/// (Mara and McGuire 2013, 2D Polyhedral Bounds of a Clipped, Perspective-Projected 3D Sphere). z > radius.
vec2 tangentSlopes(float x, float z, float radius) {
    float reach = radius * sqrt(max(x * x + z * z - radius * radius, 0.0));
    return (vec2(x * z) + vec2(-reach, reach)) / (z * z - radius * radius);
}

/// xy: least, zw: greatest film point of a pixel that may show the sphere; the film is [0,1]^2, y down, and isn't clipped to. False where the sphere is
/// behind the camera. Rays may start anywhere on the lens.
bool sphereOnFilm(World w, vec3 center, float radius, out vec4 bounds) {
    vec3 d = center - w.camera.position;
    float z = dot(d, w.camera.forward);
    vec2 extents = vec2(length(w.camera.right), length(w.camera.up)), at = vec2(dot(d, w.camera.right), dot(d, w.camera.up)) / extents;
    bounds = vec4(-FAR, -FAR, FAR, FAR);
    if (z <= -radius) return false;
    vec4 slopes;  // least and greatest across, least and greatest up
    if (w.camera.orthographic != 0u) {
        slopes = vec4(at.x - radius, at.x + radius, at.y - radius, at.y + radius);
    } else {
        // A ray through the lens is at most so far from the one through its centre as that far from the plane of focus.
        radius += w.camera.aperture * (1.0 + (max(z, 0.0) + radius) / w.camera.focus);
        if (z <= 1.001 * radius) return true;
        slopes = vec4(tangentSlopes(at.x, z, radius), tangentSlopes(at.y, z, radius));
    }
    slopes /= extents.xxyy;
    bounds = vec4(0.5 + 0.5 * slopes.x, 0.5 - 0.5 * slopes.w, 0.5 + 0.5 * slopes.y, 0.5 - 0.5 * slopes.z);
    return true;
}
