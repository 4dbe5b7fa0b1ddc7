// SPDX-License-Identifier: MIT
// A thin-lens camera, or an orthographic one: film to ray and back.
#include "base/math.glsl"
#include "base/sampling.glsl"
#include "world/ray.h"
#include "world/world.h"

const vec2 LENS_CENTRE = vec2(0.0);  // what uniformDisk takes to the middle of the disk: not the middle of the square

/// The point of the lens, relative to its centre. lens in [0,1]^2; uniform over the disk.
vec3 lensOffset(World w, vec2 lens) {
    if (w.camera.aperture <= 0.0) return vec3(0.0);
    vec2 p = w.camera.aperture * uniformDisk(lens);
    return p.x * normalize(w.camera.right) + p.y * normalize(w.camera.up);
}

/// Film point of a place inside a pixel, [0,1)^2, of an image of `size` pixels. Places are what is stored: a float of the whole film would lose
/// some of their bits, so that a path came back to another place than it left, or to the next pixel.
vec2 filmOf(ivec2 pixel, vec2 place, uvec2 size) {
    precise vec2 film = (vec2(pixel) + place) / vec2(size);
    return film;
}

/// film in [0,1]^2, x to the right and y down. All rays of one film point meet in the plane of focus. Unit direction. Orthographic: rays start in
/// the plane of the camera, side by side.
Ray cameraRay(World w, vec2 film, vec2 lens) {
    vec3 place = (2.0 * film.x - 1.0) * w.camera.right + (1.0 - 2.0 * film.y) * w.camera.up, direction = w.camera.forward + place;
    if (w.camera.orthographic != 0u) return Ray(w.camera.position + place, 0.0, w.camera.forward, FAR, 0u);
    vec3 offset = lensOffset(w, lens);
    return Ray(w.camera.position + offset, 0.0, normalize(direction - offset / w.camera.focus), FAR, 0u);
}

/// Inverse of cameraRay: xy is the film point whose ray through the same lens point passes through `point`, z the depth along the
/// camera's forward direction (<= 0: not in front, xy are outside the film).
vec3 cameraProject(World w, vec3 point, vec2 lens) {
    vec3 offset = lensOffset(w, lens);
    vec3 d = point - w.camera.position - offset;
    float depth = dot(d, w.camera.forward);
    if (!(depth > 0.0)) return vec3(-1.0, -1.0, depth);
    vec3 onPlane = w.camera.orthographic != 0u ? d : d / depth + offset / w.camera.focus;
    vec2 image = vec2(dot(onPlane, w.camera.right) / dot(w.camera.right, w.camera.right),
                      dot(onPlane, w.camera.up) / dot(w.camera.up, w.camera.up));
    return vec3(0.5 + 0.5 * image.x, 0.5 - 0.5 * image.y, depth);
}

/// The same for what is infinitely far in a direction that `film` saw it in. An orthographic camera sees one direction all over its film, so there it
/// stays at its place.
vec3 cameraProjectSky(World w, vec3 direction, vec2 film, vec2 lens) {
    if (w.camera.orthographic != 0u) return vec3(film, 1.0);
    return cameraProject(w, w.camera.position + lensOffset(w, lens) + direction, lens);
}
