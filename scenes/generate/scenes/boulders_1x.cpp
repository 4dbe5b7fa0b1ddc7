// SPDX-License-Identifier: MIT
// The field of boulders with a model of 4,800 triangles.
#include "kit/boulders.h"
#include "kit/scene.h"

namespace lodestir::generate {

static Glb makeBoulders() { return boulderField(1); }

LODESTIR_SCENE(makeBoulders, "--levels 4 --ratio 4 --mesh boulder")

}  // namespace lodestir::generate
