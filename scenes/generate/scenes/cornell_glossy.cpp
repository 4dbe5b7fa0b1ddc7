// SPDX-License-Identifier: MIT
// The Cornell box with the tall block and spheres of glass and rough gold.
#include <utility>

#include "kit/cornell_box.h"
#include "kit/scene.h"
#include "kit/shapes.h"

namespace lodestir::generate {

namespace {

Glb makeCornellGlossy() {
    CornellBox box;
    // Reflectance of gold at normal incidence, linear Rec.709.
    const int gold = box.glb.addMaterial({.name = "gold_rough", .color = {1.0f, 0.78f, 0.34f}, .roughness = 0.3f, .metalness = 1});
    const int glass = box.glb.addMaterial({.name = "glass",
                                           .roughness = 0,
                                           .transmission = 1,
                                           .ior = 1.5f,
                                           .thickness = 1.9f,
                                           .attenuation = {0.86f, 0.97f, 0.94f},
                                           .attenuationDistance = 3});
    box.put("tall_block", box.white, tallBlock());
    box.put("glass_sphere", glass, sphere(128, 64), {.translation = {1.72f, 0.951f, 1.62f}, .scale = glm::vec3(0.95f)});
    box.put("gold_sphere", gold, sphere(128, 64), {.translation = {4.02f, 0.751f, 1.35f}, .scale = glm::vec3(0.75f)});
    return std::move(box.glb);
}

}  // namespace

LODESTIR_SCENE(makeCornellGlossy)

}  // namespace lodestir::generate
