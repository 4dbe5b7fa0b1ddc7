// SPDX-License-Identifier: MIT
// How open a scene is around what pixels show: shading without lights.
#include <framework/pass/pass.h>
#include <framework/shaders/world/primary_hit.h>

using namespace lodestir;

struct AmbientOcclusion final : Pass {
    In<World> world{this, "world", "the scene"};
    In<Buffer<PrimaryHit>> hits{this, "hits", "camera hits (visibility)"};
    Out<Image> open{this, "open", "share of the cosine-weighted directions in which nothing is near, in all colours; 1 where nothing was hit", Format::rgba32f};
    Param<int> rays{this, "rays", 4, {1, 4096}, "rays a pixel and frame"};
    Param<float> radius{this, "radius", 1, {0, 1e6f}, "how near, scene units; 0: however far. Glass hides as walls do"};
};
LODESTIR_PASS(AmbientOcclusion, "ambient_occlusion.comp", "Ambient occlusion: the share of the directions above each pixel's surface in which nothing is near.")
