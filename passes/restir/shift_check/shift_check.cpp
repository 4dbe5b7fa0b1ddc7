// SPDX-License-Identifier: MIT
// Whether shifts can be undone: what a reservoir technique stands on, measured.
#include "shift_check.h"

#include <framework/pass/pass.h>
#include <passes/restir/paths.h>
#include <passes/restir/rules.h>
#include <passes/restir/similarity.h>
#include <passes/restir/suffix.h>

using namespace lodestir;

struct ShiftChecks final : Pass {
    In<World>               world{this, "world", "the scene"};
    In<World>               worldPrev{this, "worldPrev", "last frame's scene, with `history`", Need::optional};
    In<Buffer<PrimaryHit>>  hits{this, "hits", "the camera hit of each pixel"};
    In<Buffer<PrimaryHit>>  hitsPrev{this, "hitsPrev", "last frame's, with `history`", Need::optional};
    In<Image>               motion{this, "motion", "to last frame's position, pixels, with `history`", Need::optional};
    In<ShiftRules>          rules{this, "rules", "of the pass that made the paths"};
    In<Paths>               paths{this, "paths", "a path of each pixel, fresh or resampled"};
    In<Paths>               history{this, "history", "last frame's path of each pixel: paths go between the frames instead of between pixels", Need::optional};
    Out<Buffer<ShiftCheck>> checks{this, "checks",
                                   "two of each pixel: the path of its partner (a random similar pixel, or last frame's) shifted here and back, its own path "
                                   "shifted there and back",
                                   Count::perPixel(2)};
    Out<Image>              color{this, "color",
                                  "what went wrong: the shift back fails (red), leads to another path (magenta), F (orange), the Jacobian (yellow), MIS "
                                  "weights (cyan); else both came back (green), one (dark green), none left (grey), nothing to check (black)",
                                  Format::rgba16f};
    Neighbourhood           around{this};
    SuffixRule              suffix{this};
    Param<float>            tolerance{this, "tolerance", 1e-3f, {0, 1}, "errors above it are shown"};
};
LODESTIR_PASS(ShiftChecks, "shift_check.comp",
              "Shifts each pixel's path to a partner and back and measures what is lost on the way: a diagnostic for whoever changes a shift.")
