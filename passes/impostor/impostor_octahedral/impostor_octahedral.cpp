// SPDX-License-Identifier: MIT
// Octahedral impostors, drawn.
#include <passes/impostor/atlas_drawing.h>

using namespace lodestir;

enum class Parallax { off, step, relief };

struct ImpostorOctahedral final : Pass {
    AtlasDrawing    drawing{this};
    Param<Parallax> parallax{this, "parallax", Parallax::step, {"off", "step", "relief"},
                             "where a view is read: where the ray meets its plane; a step from there towards the surface below; where the ray meets the "
                             "surface"};
    Param<int>      steps{this, "steps", 16, {2, 128}, "of relief: through the sphere around the mesh"};

    void execute(Frame& frame) override {
        const Atlases made = frame.valueOf(drawing.atlases);
        if (made.arrangement > ATLAS_HEMI)
            throw Error("an impostor_octahedral has an atlas of cards", "set \"arrangement\" of its impostor_atlas to full or hemi");
        if (parallax != Parallax::off && made.isMatched == 0)
            throw Error("an impostor_octahedral has parallax, which needs depths that its atlas doesn't keep",
                        "set its \"parallax\" to off, or \"attributes\" of its impostor_atlas to matched");
        drawing.execute(frame, shader);
    }
};
LODESTIR_PASS(ImpostorOctahedral, "impostor_octahedral.comp",
              "Draws octahedral impostors: three views of an atlas mixed, with or without parallax, the nearest instance in each pixel.")
