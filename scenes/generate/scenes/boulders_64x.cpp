// SPDX-License-Identifier: MIT
// The field of boulders with a model of 307,200 triangles.
#include "kit/boulders.h"
#include "kit/scene.h"

namespace lodestir::generate {

static Glb makeBoulders() { return boulderField(8); }

LODESTIR_SCENE(makeBoulders, "--levels 7 --ratio 4 --mesh boulder")

}  // namespace lodestir::generate
