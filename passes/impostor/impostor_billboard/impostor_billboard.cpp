// SPDX-License-Identifier: MIT
// Billboards of several cards, drawn.
#include <passes/impostor/atlas_drawing.h>

using namespace lodestir;

struct ImpostorBillboard final : Pass {
    AtlasDrawing drawing{this};

    void execute(Frame& frame) override {
        if (frame.valueOf(drawing.atlases).arrangement <= ATLAS_HEMI)
            throw Error("an impostor_billboard has an atlas that is no cards", "set \"arrangement\" of its impostor_atlas to cross or star");
        drawing.execute(frame, shader);
    }
};
LODESTIR_PASS(ImpostorBillboard, "impostor_billboard.comp",
              "Draws billboards of three or four cards that cross in the middle of a mesh, the nearest instance in each pixel.")
