// SPDX-License-Identifier: MIT
// Where camera rays cross their pixel and the lens, by the parameters of film.h. After pass.glsl.
#include "base/jitter.glsl"
#include "base/random.glsl"
#include "world/camera.glsl"

/// Place inside the pixel of the sample that `seed` is of, [0,1)^2.
vec2 filmPlace(uvec2 seed) {
    if (params.film == film_centre) return vec2(0.5);
    return params.film == film_frame ? frameJitter(frameIndex(), runSeed()) : random2(seed, 0u, RANDOM_FILM);
}

/// Place on the lens of the sample that `seed` is of (world/camera.glsl).
vec2 lensPlace(uvec2 seed) { return params.lens ? random2(seed, 0u, RANDOM_LENS) : LENS_CENTRE; }
