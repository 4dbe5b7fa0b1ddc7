// SPDX-License-Identifier: MIT
// The film seen from a surface: forward projection of first hits, and how it stretches.
#include "restir/path_vertex.glsl"
#include "world/camera.glsl"

/// Film area per barycentric area of what pixel `p` of an image of `size` pixels hit (per solid angle of the environment), as seen through
/// the lens point that `hit` holds: |n.w| / r^2 and 1 / cos^3 for the inclination of the film (Liu et al. 2025, Reservoir Splatting); the film's own size
/// makes it right for a camera that zooms. Rays of an orthographic camera don't part: |n.w| alone, and nothing for the environment, which keeps its place
/// on the film.
float filmTerm(World w, ivec2 p, uvec2 size, PrimaryHit hit) {
    Ray ray = cameraRay(w, filmOf(p, hit.film, size), hit.lens);
    float connection = 1.0, film = length(w.camera.right) * length(w.camera.up);
    if (w.camera.orthographic != 0u) {
        if (hit.primitive == NONE) return 1.0;
        Surface s = surfaceAt(w, hitOf(hit), ray.direction);
        return abs(dot(s.normal, ray.direction)) * s.twiceArea / film;
    }
    vec3 direction = ray.direction;
    if (hit.primitive != NONE) {
        direction = safeNormalize(positionAt(w, pointOf(hit)) - ray.origin, direction);
        connection = connectionTerm(ray.origin, surfaceAt(w, hitOf(hit), direction));
    }
    float cosine = dot(direction, w.camera.forward);
    return cosine > 0.0 ? connection / (cosine * cosine * cosine * film) : 0.0;
}

/// What pixel `p` of a frame hit, as the camera of `to` sees it through the same lens point, and the pixel that it lands in; `direction` is that in
/// which the environment was seen. False: it is behind the camera or off the film.
bool project(World to, ivec2 p, uvec2 size, inout PrimaryHit hit, vec3 direction, out ivec2 landing) {
    vec3 seen;
    if (hit.primitive == NONE) seen = cameraProjectSky(to, direction, filmOf(p, hit.film, size), hit.lens);
    else seen = cameraProject(to, positionAt(to, pointOf(hit)), hit.lens);
    const float belowOne = 0.99999994;
    vec2 at = seen.xy * vec2(size);
    landing = min(ivec2(floor(at)), ivec2(size) - 1);
    hit.film = min(at - vec2(landing), belowOne);
    return seen.z > 0.0 && all(greaterThanEqual(seen.xy, vec2(0.0))) && all(lessThan(seen.xy, vec2(1.0)));
}
