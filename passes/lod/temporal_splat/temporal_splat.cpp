// SPDX-License-Identifier: MIT
// Last frame's paths, splatted to where their first hits are now, across changes of level.
#include <framework/pass/pass.h>
#include <passes/lod/uv_index.h>
#include <passes/restir/reservoir.h>
#include <passes/restir/rules.h>
#include <passes/restir/sample_hit.h>

#include "landing.h"

using namespace lodestir;

enum class Suffix { automatic, kept, walked };
enum class Matching { object, world };
enum class VertexMapping { triangle, uv, uv_no_matching, primary_only, reconnection_only };

struct TemporalSplat final : Pass {
    In<World>                  world{this, "world", "the scene"};
    In<World>                  worldPrev{this, "worldPrev", "last frame's scene: what the own path would have been there"};
    In<Buffer<PrimaryHit>>     hits{this, "hits", "camera hits through the pixel centres"};
    In<Buffer<PrimaryHit>>     hitsPrev{this, "hitsPrev", "last frame's"};
    In<Image>                  motion{this, "motion", "to last frame's position, pixels: whose confidence a pixel inherits, and where the backup comes from"};
    In<UvIndex>                uv{this, "uv", "triangles by texture coordinate; unwired: nothing is mapped between levels", Need::optional};
    In<ShiftRules>             rules{this, "rules", "of the pass that made the paths"};
    In<Buffer<Reservoir>>      reservoirs{this, "reservoirs", "this frame's path of each pixel"};
    In<Buffer<SampleHit>>      samples{this, "samples", "where each path begins"};
    In<Buffer<Reservoir>>      history{this, "history", "last frame's path of each pixel, after all reuse"};
    In<Buffer<SampleHit>>      historySamples{this, "historySamples", "where each of these begins"};
    Out<Buffer<Reservoir>>     reservoirsOut{this, "reservoirs", "the path of each pixel after reuse", Count::perPixel()};
    Out<Buffer<SampleHit>>     samplesOut{this, "samples", "where each begins", Count::perPixel()};
    Out<Image>                 landed{this, "landed", "paths of last frame that landed in the pixel", Format::r32f};
    Scratch<Buffer<Reservoir>> shifted{this, "shifted", "each path of last frame where it lands", Count::perPixel()};
    Scratch<Buffer<SampleHit>> shiftedSamples{this, "shiftedSamples", "where each of these begins", Count::perPixel()};
    Scratch<Buffer<Reservoir>> gathered{this, "gathered", "the path that reprojection brings", Count::perPixel()};
    Scratch<Buffer<SampleHit>> gatheredSamples{this, "gatheredSamples", "where each of these begins", Count::perPixel()};
    Scratch<Buffer<Landing>>   landings{this, "landings", "of each path of last frame", Count::perPixel()};
    Scratch<Buffer<Landing>>   gatherings{this, "gatherings", "of each path that reprojection brings", Count::perPixel()};
    Scratch<Buffer<Origins>>   origins{this, "origins", "of each path of this frame", Count::perPixel()};
    Scratch<Buffer<uint>>      counts{this, "counts", "paths that land in each pixel", Count::perPixel()};
    Scratch<Buffer<uint>>      starts{this, "starts", "where each pixel's list begins", Count::perPixel()};
    Scratch<Buffer<uint>>      lists{this, "lists", "pixels whose paths land in one pixel, one list behind another", Count::perPixel()};
    Scratch<Buffer<uint>>      cursor{this, "cursor", "end of the lists", Count::fixed(1)};
    Param<float>               cap{this, "cap", 20, {0, 1000}, "most confidence of a path of last frame, in frames' own paths; 0: no reuse"};
    Param<float>               backup{this, "backup", 0.5f, {0, 1}, "share of the history's confidence that goes to a path brought by reprojection, which is there where no path lands; 0: splatting alone"};
    Param<VertexMapping>       vertexMapping{this, "vertexMapping", VertexMapping::uv, {"triangle", "uv", "uv_no_matching", "primary_only", "reconnection_only"},
                                             "how vertices pass from level to level: not at all; by texture coordinate; by texture coordinate where one triangle has it; the first hit alone; x_k alone"};
    Param<Matching>            matching{this, "matching", Matching::object, {"object", "world"},
                                        "where points of one texture coordinate are compared by distance: as the mesh was made, or as this frame places it (which differs where a scale isn't uniform)"};
    Param<Suffix>              suffix{this, "suffix", Suffix::automatic, {"automatic", "kept", "walked"},
                                      "what follows the reconnection vertex: walked anew where anything but the camera changed since last frame, always kept (biased where things change), always walked anew"};
    PassThrough                offReservoirs{this, reservoirs, reservoirsOut};
    PassThrough                offSamples{this, samples, samplesOut};

    void execute(Frame& frame) override {
        frame.fill(counts, 0);
        frame.fill(cursor, 0);
        frame.dispatch("shift_paths.comp", frame.size());
        frame.dispatch("start_lists.comp", frame.size());
        frame.dispatch("fill_lists.comp", frame.size());
        frame.dispatch(shader, frame.size());
    }
};
LODESTIR_PASS(TemporalSplat, "temporal_splat.comp", "Splats last frame's paths to where their first hits are now and resamples them there, across changes of level (reservoir splatting).")
