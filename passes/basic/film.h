// SPDX-License-Identifier: MIT
// The parameters of passes that make camera rays: where these cross their pixel and the lens (basic/film.glsl chooses by them).
#pragma once
#include <framework/pass/parameter.h>

namespace lodestir {

enum class Film { random, centre, frame };

struct FilmPlace {
    Param<Film> film;
    Param<bool> lens;
    explicit FilmPlace(Pass* pass)
        : film{pass, "film", Film::random, {"random", "centre", "frame"},
               "where rays cross their pixel: at a random place of their own, at its centre, or at one place for all pixels of a frame, which fills "
               "the pixel evenly from frame to frame"},
          lens{pass, "lens", true, "rays from a random point of the camera's aperture instead of its centre"} {}
};

}  // namespace lodestir
