// SPDX-License-Identifier: MIT
// A rabbit by itself: ears before its back, hollows, legs apart, many triangles of one plain coat.
#include "kit/backdrop.h"
#include "kit/rabbit.h"
#include "kit/scene.h"

namespace lodestir::generate {

static Glb makeBunny() {
    Glb glb;
    glb.addNode(rabbit(glb, "bunny", 0.0021f));
    addLamp(glb, {0, 0.22f, 0}, 0.28f, {11, 10.2f, 9});
    return glb;
}

LODESTIR_SCENE(makeBunny, "--levels 5 --mesh bunny")

}  // namespace lodestir::generate
