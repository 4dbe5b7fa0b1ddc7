// SPDX-License-Identifier: MIT
// Last frame's paths, shifted into this frame.
#include <framework/pass/pass.h>
#include <passes/restir/reservoir.h>
#include <passes/restir/rules.h>
#include <passes/restir/sample_hit.h>

using namespace lodestir;

enum class Suffix { automatic, kept, walked };

struct TemporalReprojection final : Pass {
    In<World>              world{this, "world", "the scene"};
    In<World>              worldPrev{this, "worldPrev", "last frame's scene: what the own path would have been there"};
    In<Buffer<PrimaryHit>> hits{this, "hits", "camera hits through the pixel centres"};
    In<Buffer<PrimaryHit>> hitsPrev{this, "hitsPrev", "last frame's"};
    In<Image>              motion{this, "motion", "to last frame's position, pixels"};
    In<ShiftRules>         rules{this, "rules", "of the pass that made the paths"};
    In<Buffer<Reservoir>>  reservoirs{this, "reservoirs", "this frame's path of each pixel"};
    In<Buffer<SampleHit>>  samples{this, "samples", "where each path begins"};
    In<Buffer<Reservoir>>  history{this, "history", "last frame's path of each pixel, after all reuse"};
    In<Buffer<SampleHit>>  historySamples{this, "historySamples", "where each of these begins"};
    Out<Buffer<Reservoir>> reservoirsOut{this, "reservoirs", "the path of each pixel after reuse", Count::perPixel()};
    Out<Buffer<SampleHit>> samplesOut{this, "samples", "where each begins", Count::perPixel()};
    Param<float>           cap{this, "cap", 20, {0, 1000}, "most confidence of a path of last frame, in frames' own paths; 0: no reuse (Lin et al. 2022, section 6.2)"};
    Param<float>           normal{this, "normal", -1, {-1, 1}, "least cosine between the normals here and where the pixel was; -1 asks nothing"};
    Param<float>           depth{this, "depth", 1e6f, {0, 1e6f}, "most difference of depth, relative; 1e6 asks nothing"};
    Param<Suffix>          suffix{this, "suffix", Suffix::automatic, {"automatic", "kept", "walked"},
                                  "what follows the reconnection vertex: walked anew where anything but the camera moved since last frame, always kept (biased where things move), always walked anew"};
    PassThrough            offReservoirs{this, reservoirs, reservoirsOut};
    PassThrough            offSamples{this, samples, samplesOut};
};
LODESTIR_PASS(TemporalReprojection, "temporal_reprojection.comp", "Resamples each pixel's path with the one that last frame held where the pixel was (ReSTIR PT's temporal reuse).")
