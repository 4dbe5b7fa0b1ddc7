// SPDX-License-Identifier: MIT
// Whether shifts can be undone: what a reservoir technique stands on, measured.
#include "shift_check.h"

#include <framework/pass/pass.h>
#include <passes/restir/reservoir.h>
#include <passes/restir/rules.h>
#include <passes/restir/sample_hit.h>

using namespace lodestir;

enum class Suffix { automatic, kept, walked };

struct ShiftChecks final : Pass {
    In<World>               world{this, "world", "the scene"};
    In<World>               worldPrev{this, "worldPrev", "last frame's scene, with `history`", Need::optional};
    In<Buffer<PrimaryHit>>  hits{this, "hits", "camera hits through the pixel centres"};
    In<Buffer<PrimaryHit>>  hitsPrev{this, "hitsPrev", "last frame's, with `history`", Need::optional};
    In<Image>               motion{this, "motion", "to last frame's position, pixels, with `history`", Need::optional};
    In<ShiftRules>          rules{this, "rules", "of the pass that made the paths"};
    In<Buffer<Reservoir>>   reservoirs{this, "reservoirs", "a path of each pixel, fresh or resampled"};
    In<Buffer<SampleHit>>   samples{this, "samples", "where each path begins"};
    In<Buffer<Reservoir>>   history{this, "history", "last frame's path of each pixel: paths go between the frames instead of between pixels", Need::optional};
    In<Buffer<SampleHit>>   historySamples{this, "historySamples", "where each of these begins", Need::optional};
    Out<Buffer<ShiftCheck>> checks{this, "checks", "two of each pixel: the path of its partner (a random similar pixel, or last frame's) shifted here and back, its own path shifted there and back",
                                   Count::perPixel(2)};
    Out<Image>              color{this, "color", "what went wrong: the shift back fails (red), leads to another path (magenta), F (orange), the Jacobian (yellow), MIS weights (cyan); "
                                                "else both came back (green), one (dark green), none left (grey), nothing to check (black)", Format::rgba16f};
    Param<float>            radius{this, "radius", 20, {1, 200}, "of the disk that the partner is drawn from, pixels"};
    Param<float>            normal{this, "normal", 0.5f, {-1, 1}, "least cosine between the normals of pixels that are alike"};
    Param<float>            depth{this, "depth", 0.1f, {0, 1e6f}, "most difference of depth between pixels that are alike, relative"};
    Param<Suffix>           suffix{this, "suffix", Suffix::automatic, {"automatic", "kept", "walked"},
                                   "what follows the reconnection vertex: as temporal_reprojection and spatial_reuse do, always kept, always walked anew"};
    Param<float>            tolerance{this, "tolerance", 1e-3f, {0, 1}, "errors above it are shown"};
};
LODESTIR_PASS(ShiftChecks, "shift_check.comp", "Shifts each pixel's path to a partner and back and measures what is lost on the way: a diagnostic for whoever changes a shift.")
