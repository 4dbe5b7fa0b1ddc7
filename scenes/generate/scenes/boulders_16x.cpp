// SPDX-License-Identifier: MIT
// The field of boulders with a model of 76,800 triangles.
#include "kit/boulders.h"
#include "kit/scene.h"

namespace lodestir::generate {

static Glb makeBoulders() { return boulderField(4); }

LODESTIR_SCENE(makeBoulders, "--levels 6 --ratio 4 --mesh boulder")

}  // namespace lodestir::generate
