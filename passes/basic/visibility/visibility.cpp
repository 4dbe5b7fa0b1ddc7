// SPDX-License-Identifier: MIT
// The first hits of a frame and what is known of them without shading.
#include <framework/pass/pass.h>
#include <framework/shaders/impostor/surfel.h>
#include <framework/shaders/world/primary_hit.h>
#include <passes/basic/film.h>

using namespace lodestir;

struct Visibility final : Pass {
    In<World>               world{this, "world", "the scene"};
    In<World>               worldPrev{this, "worldPrev", "last frame's scene, for motion; unwired: motion of the camera and of the instances is zero",
                                      Need::optional};
    In<Buffer<Surfel>>      surfels{this, "surfels", "what pixels show of impostors: where it is nearer than what rays hit, the hit is a point of its texel",
                               Need::optional};
    In<World>               rest{this, "rest", "with surfels: the scene that camera rays are traced in, without what is drawn as impostors", Need::optional};
    Out<Buffer<PrimaryHit>> hits{this, "hits", "first hit of each pixel, with its film and lens sample", Count::perPixel()};
    Out<Image>              motion{this, "motion", "from this frame's position of the hit to last frame's, pixels, y down", Format::rg32f, Need::optional};
    Out<Image>              depth{this, "depth", "distance along the view direction, scene units; 0 where nothing was hit", Format::r32f, Need::optional};
    Out<Image>              normal{this, "normal", "shading normal, world space; zero where nothing was hit", Format::rgba16f, Need::optional};
    Out<Image>              albedo{this, "albedo", "base colour, linear; zero where nothing was hit", Format::rgba16f, Need::optional};
    FilmPlace               place{this};
    Fact                    texels{this, "TEXEL_SURFACES", surfels};

    void execute(Frame& frame) override {
        if (frame.isBound(surfels) && !frame.isBound(rest))
            throw Error("a visibility has surfels, but traces the meshes that they stand for as well", "wire its \"rest\" to that of the impostor_forward_map");
        Pass::execute(frame);
    }
};
LODESTIR_PASS(Visibility, "visibility.comp", "Finds the first hit of one camera ray a pixel: hits, motion, depth, normal, albedo.")
