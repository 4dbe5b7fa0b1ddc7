// SPDX-License-Identifier: MIT
// Impostors to look at.
#include <framework/pass/pass.h>
#include <framework/pass/scene.h>

#include <framework/shaders/impostor/impostors.h>

#include "shown_texel.h"

using namespace lodestir;

enum class Shown { normal, depth, alpha, uv, material, length };

struct ImpostorView final : Pass {
    In<Impostors>           impostors{this, "impostors", "what impostor_bake made"};
    Out<Image>              color{this, "color", "the views of a mesh side by side, black where they see nothing", Format::rgba16f};
    Out<Buffer<ShownTexel>> texels{this, "texels", "the texel that each pixel shows", Count::perPixel()};
    Param<std::string>      mesh{this, "mesh", "", "name of the mesh; empty: the first that was baked"};
    Param<int>              level{this, "level", 0, {0, 8}, "of the pyramid, 0 being the finest; the coarsest where it has fewer"};
    Param<int>              view{this, "view", -1, {-1, 17}, "the only view to show, which fills the frame; -1: all"};
    Param<Shown>            show{this, "show", Shown::normal, {"normal", "depth", "alpha", "uv", "material", "length"},
                      "normal in object space, from [-1, 1] to [0, 1]; depth, near is bright; alpha; texture coordinates; a colour for each material; "
                      "length of the mean normal, 1 where all agree"};

    void execute(Frame& frame) override {
        const std::string& wanted = mesh;
        const std::uint32_t index = wanted.empty() ? NONE : namedThing(frame.scene(), frame.scene().meshes, wanted, "mesh", "an impostor_view to show");
        frame.dispatch(shader, frame.size(), {index});
    }
};
LODESTIR_PASS(ImpostorView, "impostor_view.comp", "Shows the views of an impostor side by side, at any level of their pyramids.")
