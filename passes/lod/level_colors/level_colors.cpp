// SPDX-License-Identifier: MIT
// Which level each pixel shows, as a colour.
#include <framework/pass/pass.h>
#include <framework/shaders/world/primary_hit.h>

using namespace lodestir;

struct LevelColors final : Pass {
    In<World> world{this, "world", "the scene"};
    In<Buffer<PrimaryHit>> hits{this, "hits", "camera hits (visibility)"};
    In<Image> light{this, "light", "what colours are multiplied with: ambient occlusion, say", Need::optional};
    Out<Image> color{this, "color",
                     "from red, the finest level of the mesh, over yellow, green and cyan to blue, its coarsest; grey where it has one only, black where "
                     "nothing was hit; linear Rec. 709",
                     Format::rgba16f};
    Param<bool> shading{this, "shading", true, "darker where the surface turns away from the camera: by the cosine, down to a quarter"};
};
LODESTIR_PASS(LevelColors, "level_colors.comp",
              "Shows levels of detail as colours. The level is that of the triangle that was hit: also where rays see levels of their own.")
