// SPDX-License-Identifier: MIT
// Last frame's paths, shifted into this frame.
#include <framework/pass/pass.h>
#include <passes/rate/rates.h>
#include <passes/restir/history.h>
#include <passes/restir/paths.h>
#include <passes/restir/rules.h>
#include <passes/restir/similarity.h>
#include <passes/restir/suffix.h>

using namespace lodestir;

enum class Gather { nearest, fractional };

struct TemporalReprojection final : Pass {
    In<World>              world{this, "world", "the scene"};
    In<World>              worldPrev{this, "worldPrev", "last frame's scene: what the own path would have been there"};
    In<Buffer<PrimaryHit>> hits{this, "hits", "the camera hit of each pixel"};
    In<Buffer<PrimaryHit>> hitsPrev{this, "hitsPrev", "last frame's"};
    In<Image>              motion{this, "motion", "to last frame's position, pixels"};
    In<ShiftRules>         rules{this, "rules", "of the pass that made the paths"};
    In<Paths>              paths{this, "paths", "this frame's path of each pixel"};
    In<Paths>              history{this, "history", "last frame's path of each pixel, after all reuse"};
    In<Rates>              rates{this, "rates", "pixels that reuse anything; the others stay empty, and nobody reuses them: an image of lower resolution, "
                                 "for upsample; unwired: all",
                                 Need::optional};
    Out<Paths>             pathsOut{this, "paths", "the path of each pixel after reuse", Count::perPixel()};
    Out<Image>             color{this, "color",
                                     "radiance from the weights of all candidates instead of the kept one's (Lin et al. 2026, section 6.3), linear Rec. 709",
                                 Format::rgba32f, Need::optional};
    Param<Gather>          gather{this, "gather", Gather::nearest, {"nearest", "fractional"},
                                  "where the pixel's past is: the pixel that its centre was in, whose path keeps its place inside the pixel; or the four that "
                                  "it lay on, of whose paths each keeps its place on what is seen, moved by fractions of a pixel as well (Zhang et al. 2024, "
                                  "Area ReSTIR). The nearest wherever the camera sample isn't the path's (camera of initial_sampling)"};
    History                reused{this};
    Similarity             similarity{this, -1, 1e6f};
    SuffixRule             suffix{this};
    PassThrough            off{this, paths, pathsOut};
    InPlace                over{this, paths, pathsOut};

    void execute(Frame& frame) override {
        if (gather == Gather::fractional && frame.isBound(rates))
            throw Error("a temporal_reprojection can't gather by fractions of pixels where blocks of pixels share a path",
                        "unwire \"rates\", or set \"gather\" to \"nearest\"");
        frame.dispatch(shader, walkExtent(frame.size(), frame.isBound(rates)));
    }
};
LODESTIR_PASS(TemporalReprojection, "temporal_reprojection.comp",
              "Resamples each pixel's path with the one that last frame held where the pixel was (ReSTIR PT's temporal reuse).")
