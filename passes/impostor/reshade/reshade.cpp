// SPDX-License-Identifier: MIT
// Direct light on what pixels show, without noise: the same for impostors, for the atlases they are compared with, and for the geometry they stand for.
#include <framework/pass/pass.h>
#include <framework/shaders/impostor/impostors.h>
#include <framework/shaders/impostor/surfel.h>
#include <framework/shaders/world/primary_hit.h>
#include <passes/impostor/baked_surface.h>

using namespace lodestir;

struct Reshade final : Pass {
    In<World>                world{this, "world", "the scene: its materials and lights as they are now"};
    In<Buffer<PrimaryHit>>   hits{this, "hits", "geometry that is shaded: camera hits", Need::optional};
    In<Buffer<Surfel>>       surfels{this, "surfels", "impostors that are shaded", Need::optional};
    In<Impostors>            impostors{this, "impostors", "that the surfels are texels of", Need::optional};
    In<Buffer<BakedSurface>> baked{this, "baked", "what an atlas of colours shows, which is shaded", Need::optional};
    Out<Image>               color{this, "color", "radiance towards the camera, linear Rec. 709; alpha: share of the pixel that is covered", Format::rgba32f};
    Out<Image>               depth{this, "depth", "distance along the view direction, scene units; 0 where nothing is shown", Format::r32f, Need::optional};
    Param<int>               samples{this, "samples", 16, {1, 1024}, "light samples a pixel, and directions of the BSDF that the environment is read in; the "
                                                                     "same for all pixels, so that what is left of their error is no noise"};
    Param<bool>              shadows{this, "shadows", false, "rays that ask how much of the light arrives"};
    Param<bool>              spread{this, "spread", true,
                                    "of surfels: highlights are as wide as normals differ within a texel, by the length of their mean"};

    void execute(Frame& frame) override {
        const int wired = int(frame.isBound(hits)) + int(frame.isBound(surfels)) + int(frame.isBound(baked));
        if (wired != 1)
            throw Error("a reshade has " + std::to_string(wired) + " kinds of surfaces to shade",
                        "wire one of \"hits\" (geometry), \"surfels\" (impostors) and \"baked\" (atlases)");
        if (frame.isBound(surfels) && !frame.isBound(impostors))
            throw Error("a reshade has surfels whose impostors it doesn't know", "wire its \"impostors\" to the impostor_bake that they come from");
        frame.dispatch(shader, frame.size());
    }
};
LODESTIR_PASS(Reshade, "reshade.comp", "Shades what pixels show by direct light, with the materials and lights of this frame: impostors, atlases, or geometry.")
