// SPDX-License-Identifier: MIT
// Paths of neighbours, shifted here.
#include <framework/pass/pass.h>
#include <passes/lod/uv_index.h>
#include <passes/rate/rates.h>
#include <passes/restir/pairing.h>
#include <passes/restir/pairwise.h>
#include <passes/restir/paths.h>
#include <passes/restir/rounds.h>
#include <passes/restir/rules.h>
#include <passes/restir/similarity.h>

using namespace lodestir;

struct SpatialReuse final : Pass {
    In<World>              world{this, "world", "the scene"};
    In<Buffer<PrimaryHit>> hits{this, "hits", "the camera hit of each pixel: which pixels are alike"};
    In<ShiftRules>         rules{this, "rules", "of the pass that made the paths"};
    In<PairingTables>      pairing{this, "pairing",
                                   "neighbours are these partners instead of random ones: spatial_paired_reuse shares the shifts between them, here each pixel "
                                   "makes its own, to compare", Need::optional};
    In<Paths>              paths{this, "paths", "a path of each pixel"};
    In<UvIndex>            uv{this, "uv",
                              "by which reconnection vertices pass from level to level where neighbours see different ones of an instance (lod_select, mode "
                              "stochastic, and initial_sampling, camera hits); without, such paths aren't reused", Need::optional};
    In<Rates>              rates{this, "rates", "pixels that reuse anything; the others stay empty, and nobody reuses them: an image of lower resolution, "
                                 "for upsample; unwired: all",
                                 Need::optional};
    Out<Paths>             pathsOut{this, "paths", "the path of each pixel after reuse", Count::perPixel()};
    Out<Image>             color{this, "color",
                                 "radiance from the weights of all candidates of the last round instead of the kept one's (Lin et al. 2026, section 6.3), "
                                 "linear Rec. 709",
                                 Format::rgba32f, Need::optional};
    Scratch<Paths>         between{this, "between", "what one round hands to the next", Count::reserved()};
    Param<int>             neighbours{this, "neighbours", 3, {1, 16}, "neighbours a round"};
    Param<int>             rounds{this, "rounds", 1, {1, 8}, "each round reuses what the one before it made"};
    Neighbourhood          around{this};
    PairwiseRule           weights{this};
    PassThrough            off{this, paths, pathsOut};

    void execute(Frame& frame) override {
        const glm::uvec2 size = frame.size(), extent = walkExtent(size, frame.isBound(rates));
        frame.reserve(between, rounds > 1 ? size.x * size.y : 0);
        forRounds(std::uint32_t(rounds), [&](std::uint32_t round, std::uint32_t from, std::uint32_t to) {
            frame.dispatch(shader, extent, {round, from, to});
        });
    }
};
LODESTIR_PASS(SpatialReuse, "spatial_reuse.comp",
              "Resamples each pixel's path with paths of random neighbours, shifted there and back (ReSTIR PT's spatial reuse).")
