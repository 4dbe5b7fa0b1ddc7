// SPDX-License-Identifier: MIT
// A smooth ball: whatever corner its outline shows is the method's.
#include "kit/backdrop.h"
#include "kit/scene.h"
#include "kit/shapes.h"

namespace lodestir::generate {

static Glb makeSphere() {
    Glb glb;
    Model model{"sphere", {}};
    model.add(glb.addMaterial({.name = "sphere", .color = {0.55f, 0.16f, 0.09f}, .roughness = 0.35f}), sphere(256, 200));
    glb.addNode(model);
    addLamp(glb, {0, 0, 0}, 1, {11, 10.2f, 9});
    return glb;
}

LODESTIR_SCENE(makeSphere, "--levels 5 --ratio 4 --mesh sphere")

}  // namespace lodestir::generate
