// SPDX-License-Identifier: MIT
// Last frame's paths, splatted to where their first hits are now, across changes of level.
#include <framework/pass/pass.h>
#include <passes/lod/uv_index.h>
#include <passes/restir/history.h>
#include <passes/restir/paths.h>
#include <passes/restir/rules.h>
#include <passes/restir/suffix.h>

#include "landing.h"

#include <cstring>

using namespace lodestir;

enum class Inherits { where_found, always };
enum class Matching { object, world };
enum class VertexMapping { triangle, uv, uv_no_matching, primary_only, reconnection_only };

struct TemporalSplat final : Pass {
    In<World>                world{this, "world", "the scene"};
    In<World>                worldPrev{this, "worldPrev", "last frame's scene: what the own path would have been there"};
    In<Buffer<PrimaryHit>>   hits{this, "hits", "the camera hit of each pixel"};
    In<Buffer<PrimaryHit>>   hitsPrev{this, "hitsPrev", "last frame's"};
    In<Image>                motion{this, "motion", "to last frame's position, pixels: whose confidence a pixel inherits, and where the backup comes from"};
    In<UvIndex>              uv{this, "uv", "triangles by texture coordinate; unwired: nothing is mapped between levels", Need::optional};
    In<ShiftRules>           rules{this, "rules", "of the pass that made the paths"};
    In<Paths>                paths{this, "paths", "this frame's path of each pixel"};
    In<Paths>                history{this, "history", "last frame's path of each pixel, after all reuse"};
    Out<Paths>               pathsOut{this, "paths", "the path of each pixel after reuse", Count::perPixel()};
    Out<Image>               landed{this, "landed", "splats of last frame's paths that landed in the pixel", Format::r32f, Need::optional};
    Out<Image>               color{this, "color",
                                     "radiance from the weights of all candidates instead of the kept one's (Lin et al. 2026, section 6.3), linear Rec. 709",
                                   Format::rgba32f, Need::optional};
    Scratch<Paths>           shifted{this, "shifted", "each path of last frame where it lands, as often as it is splatted", Count::reserved()};
    Scratch<Paths>           gathered{this, "gathered", "the path that reprojection brings", Count::reserved()};
    Scratch<Buffer<Landing>> landings{this, "landings", "of each splat", Count::reserved()};
    Scratch<Buffer<Landing>> gatherings{this, "gatherings", "of each path that reprojection brings", Count::reserved()};
    Scratch<Buffer<Origins>> origins{this, "origins", "of each path of this frame", Count::perPixel()};
    Scratch<Buffer<uint>>    counts{this, "counts", "splats that land in each pixel", Count::perPixel()};
    Scratch<Buffer<uint>>    ends{this, "ends", "where each pixel's list ends, which grows as it is filled", Count::perPixel()};
    Scratch<Buffer<uint>>    lists{this, "lists", "splats that land in one pixel, one list behind another", Count::reserved()};
    Scratch<Buffer<uint>>    cursor{this, "cursor", "end of the lists", Count::fixed(1)};
    History                  reused{this};
    Param<float>             backup{this, "backup", 0.5f, {0, 1},
                                    "share of the history's confidence that goes to a path brought by reprojection, which is there where no path lands; "
                                    "0: splatting alone; 1 wherever the camera sample isn't the path's (camera of initial_sampling), whose place on the "
                                    "film can't move"};
    Param<int>               partitions{this, "partitions", 2, {1, 8},
                                        "parts of the exposure that each path is splatted to, while the shutter is open to anything that moves, the camera "
                                        "included"};
    Param<VertexMapping>     vertexMapping{this, "vertexMapping", VertexMapping::uv, {"triangle", "uv", "uv_no_matching", "primary_only", "reconnection_only"},
                                           "how vertices pass from level to level: not at all; by texture coordinate; by texture coordinate where one triangle "
                                           "has it; the first hit alone; x_k alone"};
    Param<Matching>          matching{this, "matching", Matching::object, {"object", "world"},
                                      "where points of one texture coordinate are compared by distance: as the mesh was made, or as this frame places it "
                                      "(which differs where a scale isn't uniform)"};
    Param<Inherits>          inherits{this, "inherits", Inherits::where_found, {"where_found", "always"},
                                      "a pixel's confidence of its history: only where what its centre sees is found on last frame's level, or, as published, "
                                      "also where no path of last frame can have arrived"};
    SuffixRule               suffix{this};
    PassThrough              off{this, paths, pathsOut};
    InPlace                  over{this, paths, pathsOut};

    void execute(Frame& frame) override {
        const std::uint32_t pixels = frame.size().x * frame.size().y, each = splatsOfPath(frame), splats = each * pixels;
        const bool reprojects = each == 0 || backup > 0;
        frame.reserve(shifted, splats);
        frame.reserve(landings, splats);
        frame.reserve(lists, splats);
        frame.reserve(gathered, reprojects ? pixels : 0);
        frame.reserve(gatherings, reprojects ? pixels : 0);
        frame.fill(counts, 0);
        frame.fill(cursor, 0);
        frame.dispatch("shift_paths.comp", frame.size(), {each});
        frame.dispatch("start_lists.comp", frame.size());
        frame.dispatch("fill_lists.comp", frame.size(), {each});
        frame.dispatch(shader, frame.size(), {each});
    }

private:
    /// Once, unless the exposure has parts that differ; not at all where the camera sample isn't the path's.
    std::uint32_t splatsOfPath(const Frame& frame) const {
        if (frame.valueOf(rules).pixelCamera != 0) return 0;
        const World now = frame.valueOf(world);
        const bool moves = now.closing != 0 || std::memcmp(&now.camera, &now.closingCamera, sizeof now.camera) != 0;
        return moves ? std::uint32_t(partitions) : 1;
    }
};
LODESTIR_PASS(TemporalSplat, "temporal_splat.comp",
              "Splats last frame's paths to where their first hits are now and resamples them there, across changes of level (reservoir splatting).")
