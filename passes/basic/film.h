// SPDX-License-Identifier: MIT
// The parameter of passes that make camera rays: where these cross their pixel (basic/film.glsl chooses by it).
#pragma once
#include <framework/pass/parameter.h>

namespace lodestir {

enum class Film { random, centre, frame };

struct FilmPlace {
    Param<Film> film;
    explicit FilmPlace(Pass* pass)
        : film{pass, "film", Film::random, {"random", "centre", "frame"},
               "where rays cross their pixel: at a random place of their own, at its centre, or at one place for all pixels of a frame, which fills "
               "the pixel evenly from frame to frame"} {}
};

}  // namespace lodestir
