// SPDX-License-Identifier: MIT
// A fallow buck by itself: thin branching antlers, a coat of fine texture.
#include "kit/backdrop.h"
#include "kit/deer.h"
#include "kit/scene.h"

namespace lodestir::generate {

static Glb makeDeer() {
    Glb glb;
    glb.addNode(deer(glb, "deer", 2048));
    addLamp(glb, {0.1f, 1.05f, 0}, 1.25f, {11, 10.2f, 9});
    return glb;
}

LODESTIR_SCENE(makeDeer, "--levels 4 --mesh deer")

}  // namespace lodestir::generate
