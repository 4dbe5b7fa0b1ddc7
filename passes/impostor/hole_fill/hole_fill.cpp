// SPDX-License-Identifier: MIT
// Pixels that no texel landed in though the surface goes on there, and those through which one sees what lies behind it.
#include <framework/pass/pass.h>
#include <framework/shaders/impostor/surfel.h>

using namespace lodestir;

struct HoleFill final : Pass {
    In<World>               world{this, "world", "the scene: its camera"};
    In<Buffer<Surfel>>      surfels{this, "surfels", "what pixels show, with holes"};
    Out<Buffer<Surfel>>     surfelsOut{this, "surfels", "the same with holes filled", Count::perPixel()};
    Out<Image>              filled{this, "filled", "1: filled from its block, 2: as part of something thin or of a crack, 0: as it was", Format::r32f,
                                   Need::optional};
    Scratch<Buffer<Surfel>> blocks{this, "blocks", "after the first stage", Count::perPixel()};
    Param<bool>             stage1{this, "stage1", true, "holes are filled from their block of pixels by a joint bilateral filter (RiLoD, section 3.4)"};
    Param<bool>             stage2{this, "stage2", true, "then what is thin is joined and what is cracked is closed, by its depth (RiLoD, section 3.4)"};
    Param<int>              apron{this, "apron", 2, {0, 8}, "pixels around its block of 8x8 that a pixel is filled from as well: without, blocks show"};
    Param<float>            sigma{this, "sigma", 2, {0.1f, 16}, "of the weight by distance on the screen, pixels"};
    Param<float>            sigmaSurface{this, "sigmaSurface", 3, {0.1f, 64}, "of the weight by distance along the surface, pixels' widths at its depth"};
    Param<float>            sigmaDepth{this, "sigmaDepth", 2, {0.1f, 64}, "of the weight by distance from the plane, pixels' widths at its depth"};
    Param<float>            sharpness{this, "sharpness", 32, {0, 256}, "power of the cosine between normals"};
    PassThrough             off{this, surfels, surfelsOut};

    void execute(Frame& frame) override {
        frame.dispatch("blocks.comp", frame.size());
        frame.dispatch(shader, frame.size());
    }
};
LODESTIR_PASS(HoleFill, "hole_fill.comp", "Fills the holes of scattered impostors: by a bilateral filter over blocks, then along what is thin.")
