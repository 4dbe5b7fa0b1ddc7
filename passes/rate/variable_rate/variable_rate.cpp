// SPDX-License-Identifier: MIT
// Which pixels trace a path of their own this frame; the others live on what reuse brings.
#include "needs.h"

#include <framework/pass/pass.h>
#include <framework/shaders/world/primary_hit.h>
#include <passes/rate/rate_memory.h>
#include <passes/rate/rates.h>
#include <passes/restir/paths.h>
#include <passes/restir/similarity.h>

#include <algorithm>

using namespace lodestir;

enum class Manner { uniform, budget, quality, after };
enum class Tile { two, eight, sixteen };
enum class Coarsest { quad, four };
enum class Choice { cycle, random, fixed };

struct VariableRate final : Pass {
    In<World>                   world{this, "world", "the scene"};
    In<World>                   worldPrev{this, "worldPrev", "last frame's scene: where levels have switched, and what pixels saw"};
    In<Buffer<PrimaryHit>>      hits{this, "hits", "the camera hit of each pixel"};
    In<Buffer<PrimaryHit>>      hitsPrev{this, "hitsPrev", "last frame's: what was not seen then is traced; unwired: whatever lies in the image was seen",
                                    Need::optional};
    In<Image>                   motion{this, "motion", "to last frame's position, pixels; unwired: zero", Need::optional};
    In<Image>                   depths{this, "depths", "of the hits, for edges and the axis along which pixels share; unwired: no edges", Need::optional};
    In<Image>                   normals{this, "normals", "of the hits, likewise", Need::optional};
    In<Image>                   color{this, "color", "last frame's radiance, whose noise is a guide", Need::optional};
    In<Paths>                   paths{this, "paths", "last frame's paths after all reuse: confidence and nearness as guides", Need::optional};
    In<Image>                   duplication{this, "duplication", "last frame's map of copies (duplication_map), as a guide", Need::optional};
    Out<Rates>                  rates{this, "rates", "which pixels to trace, for initial_sampling", Count::perPixel()};
    Out<Image>                  colors{this, "colors",
                                      "rates as colours: red 1x1, yellow 1x2 and 2x1, green 2x2, blue 4x4, white where a pixel has to be traced; dim where it "
                                      "isn't",
                                      Format::rgba8, Need::optional};
    State<Buffer<RateMemory>>   memory{this, "memory", "of each pixel", Count::perPixel()};
    State<Buffer<float>>        frameMean{this, "frameMean", "mean luminance of the image", Count::fixed(1)};
    Scratch<Buffer<RateMemory>> carried{this, "carried", "the memory of each pixel, from where it was", Count::perPixel()};
    Scratch<Buffer<PixelNeed>>  needs{this, "needs", "of each pixel", Count::perPixel()};
    Scratch<Buffer<TileNeed>>   tiles{this, "tiles", "need of each tile", Count::reserved()};
    Scratch<Buffer<float>>      balance{this, "balance", "share of a tile's pixels for its need, so that the budget is met", Count::fixed(1)};
    Param<Manner>               manner{this, "manner", Manner::quality, {"uniform", "budget", "quality", "after"},
                                       "how tiles get their rates: all the same share; shares of one budget by the largest need of their pixels, rounded at "
                                       "random; "
                                       "by average and largest need and what they were last frame; likewise, but from the next frame on, as where rates are "
                                       "computed "
                                       "after tracing"};
    Param<float>                budget{this, "budget", 0.5f, {0.0625f, 1},
                                       "uniform, budget: share of the pixels to be traced (uniform: besides those that have to be)"};
    Param<float>                detail{this, "detail", 0.5f, {0.01f, 10},
                                       "quality, after: need from which on each pixel is traced; half of it: every second, and so on"};
    Param<Tile>                 tile{this, "tile", Tile::sixteen, {"2x2", "8x8", "16x16"}, "pixels that get one rate, but for the axis"};
    Param<Coarsest>             coarsest{this, "coarsest", Coarsest::quad, {"2x2", "4x4"}, "most pixels that share a path; with tiles of 2x2: 2x2"};
    Param<Choice>               choice{this, "choice", Choice::random, {"cycle", "random", "fixed"},
                                       "which pixel of a block is traced: each in turn, from a random one on; any; always its first, as in an image of lower "
                                       "resolution. Where paths are weighed by the chance (initial_sampling.skipped roulette) and guides look at history, "
                                       "only random "
                                       "is unbiased, and only then is a budget met that waiting pixels take part in"};
    Param<bool>                 forced{this, "forced", true,
                                       "pixels are traced whatever their rate that nothing else could fill: new ones, mirrors, what changed its level, what "
                                       "has "
                                       "fewer than two neighbours alike, what has waited for `age` frames"};
    Param<int>                  memoryFrames{this, "memoryFrames", 4, {1, 4}, "quality, after: frames whose finest rate counts"};
    Param<int>                  age{this, "age", 16, {1, 255}, "each pixel is traced once in so many frames at least"};
    Param<int>                  reach{this, "reach", 1, {0, 4},
                                      "a pixel needs what the neediest so many pixels around needs: one whose paths all missed what is bright isn't done"};
    Param<float>                noise{this, "noise", 1, {0, 1},
                                      "weight of noise in `color`, over frames, or over 7x7 pixels where fewer than four are known; 0: not asked, as with "
                                      "the next"};
    Param<float>                confidence{this, "confidence", 0.25f, {0, 1}, "weight of missing confidence in `paths`"};
    Param<float>                cap{this, "cap", 20, {1, 1000}, "confidence at which none is missing"};
    Param<float>                copies{this, "copies", 0.5f, {0, 1}, "weight of copies in `duplication`"};
    Param<float>                specular{this, "specular", 1, {0, 1}, "weight of smooth lobes at the hit"};
    Param<float>                nearness{this, "nearness", 0.25f, {0, 1}, "weight of how near to the hit its path in `paths` goes on"};
    Param<float>                edges{this, "edges", 0.5f, {0, 1}, "weight of neighbours that see other surfaces, by `depths` and `normals`"};
    Param<float>                mirror{this, "mirror", 0.05f, {0, 1},
                                       "perceptual roughness below which each pixel is traced, where that lobe takes a fifth of the light"};
    Similarity                  similarity{this};

    void execute(Frame& frame) override {
        const glm::uvec2 size = frame.size(), quads = glm::max((size + 1u) / 2u, glm::uvec2(1, 2));  // 2: never a row, which comes in groups of 64x1
        const std::uint32_t side = TILE_SIDES[std::size_t(Tile(tile))];
        const glm::uvec2 across = (size + side - 1u) / side;
        frame.reserve(tiles, across.x * across.y);
        frame.dispatch("need.comp", size);
        frame.dispatch("tiles.comp", quads);
        frame.dispatch("budget.comp", {64, 1});
        frame.dispatch(shader, quads);
    }
};
LODESTIR_PASS(VariableRate, "variable_rate.comp", "Decides which pixels trace a path of their own, by what neighbours and earlier frames leave to be done.")
