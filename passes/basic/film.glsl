// SPDX-License-Identifier: MIT
// Where camera rays cross their pixel and the lens, by the parameters of film.h. After pass.glsl.
#include "base/jitter.glsl"
#include "base/random.glsl"

/// Place inside the pixel of the sample that `seed` is of, [0,1)^2.
vec2 filmPlace(uvec2 seed) {
    if (params.film == film_centre) return vec2(0.5);
    return params.film == film_frame ? frameJitter(frameIndex(), runSeed()) : random2(seed, 0u, RANDOM_FILM);
}

/// Place on the lens of the sample that `seed` is of, in the square that covers the disk: the middle of one is that of the other.
vec2 lensPlace(uvec2 seed) { return params.lens ? random2(seed, 0u, RANDOM_LENS) : vec2(0.5); }
