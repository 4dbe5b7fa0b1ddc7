// SPDX-License-Identifier: MIT
// Paths of neighbours, shifted here.
#include <framework/pass/pass.h>
#include <passes/restir/reservoir.h>
#include <passes/restir/rules.h>
#include <passes/restir/sample_hit.h>

using namespace lodestir;

enum class Mis { defensive, pairwise };

struct SpatialReuse final : Pass {
    In<World>                  world{this, "world", "the scene"};
    In<Buffer<PrimaryHit>>     hits{this, "hits", "camera hits through the pixel centres: which pixels are alike"};
    In<ShiftRules>             rules{this, "rules", "of the pass that made the paths"};
    In<Buffer<Reservoir>>      reservoirs{this, "reservoirs", "a path of each pixel"};
    In<Buffer<SampleHit>>      samples{this, "samples", "where each path begins"};
    Out<Buffer<Reservoir>>     reservoirsOut{this, "reservoirs", "the path of each pixel after reuse", Count::perPixel()};
    Out<Buffer<SampleHit>>     samplesOut{this, "samples", "where each begins", Count::perPixel()};
    Out<Image>                 color{this, "color", "radiance from the weights of all candidates of the last round instead of the kept one's (Lin et al. 2026, section 6.3), linear Rec. 709", Format::rgba32f};
    Scratch<Buffer<Reservoir>> reservoirsBetween{this, "reservoirsBetween", "reservoirs between two rounds", Count::perPixel()};
    Scratch<Buffer<SampleHit>> samplesBetween{this, "samplesBetween", "samples between two rounds", Count::perPixel()};
    Param<int>                 neighbours{this, "neighbours", 3, {1, 16}, "neighbours a round"};
    Param<float>               radius{this, "radius", 20, {1, 200}, "of the disk that neighbours are drawn from, pixels"};
    Param<int>                 rounds{this, "rounds", 1, {1, 8}, "each round reuses what the one before it made"};
    Param<float>               normal{this, "normal", 0.5f, {-1, 1}, "least cosine between the normals of pixels that are alike"};
    Param<float>               depth{this, "depth", 0.1f, {0, 1e6f}, "most difference of depth between pixels that are alike, relative"};
    Param<Mis>                 mis{this, "mis", Mis::defensive, {"defensive", "pairwise"}, "resampling MIS weights: pairwise, with or without a share that is the pixel's own whatever neighbours say"};
    PassThrough                offReservoirs{this, reservoirs, reservoirsOut};
    PassThrough                offSamples{this, samples, samplesOut};

    /// Rounds alternate between two buffers so that the last one writes the output: argument 0 tells the round, 1 where it reads (0: input, 1: output, 2: between).
    void execute(Frame& frame) override {
        for (int round = 0, from = 0; round < rounds; ++round) {
            const bool toOutput = (rounds - round) % 2 == 1;
            frame.dispatch(shader, frame.size(), {std::uint32_t(round), std::uint32_t(from), toOutput});
            from = toOutput ? 1 : 2;
        }
    }
};
LODESTIR_PASS(SpatialReuse, "spatial_reuse.comp", "Resamples each pixel's path with paths of random neighbours, shifted there and back (ReSTIR PT's spatial reuse).")
