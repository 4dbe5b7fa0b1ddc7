// SPDX-License-Identifier: MIT
// A bush by itself: leaves cut out by alpha and seen from both sides, of which most hide others.
#include "kit/backdrop.h"
#include "kit/foliage.h"
#include "kit/scene.h"

namespace lodestir::generate {

static Glb makeFoliage() {
    Glb glb;
    const auto leaf = [&](const char* name, uint32_t seed, const LeafPaint& paint) {
        return glb.addMaterial(glb.dressed({.name = name, .mask = true, .doubleSided = true}, paintLeaf(seed, 256, paint)));
    };
    const int old = leaf("old_leaf", 1, {}), young = leaf("young_leaf", 2, {{0.11f, 0.22f, 0.035f}, {0.20f, 0.30f, 0.055f}, {0.34f, 0.42f, 0.14f}}),
              red = leaf("red_leaf", 3, {{0.22f, 0.035f, 0.022f}, {0.36f, 0.075f, 0.026f}, {0.50f, 0.25f, 0.10f}});
    const int bark = glb.addMaterial({.name = "bark", .color = {0.11f, 0.075f, 0.05f}, .roughness = 0.85f});
    glb.addNode(bush("foliage", 5, 1, {{old, young, old, old, young, old, red}, bark}));
    addLamp(glb, {0, 0.5f, 0}, 0.65f, {11, 10.2f, 9});
    return glb;
}

LODESTIR_SCENE(makeFoliage)

}  // namespace lodestir::generate
