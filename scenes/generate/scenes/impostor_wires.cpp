// SPDX-License-Identifier: MIT
// A grid of wires, half a pixel wide at its left and its foot, four pixels at its right and its top: at 512x512, for the camera of scenes/impostor_wires.json.
#include <string>

#include "kit/backdrop.h"
#include "kit/metals.h"
#include "kit/scene.h"
#include "kit/shapes.h"

namespace lodestir::generate {

namespace {

/// Metres that a pixel spans at the grid's middle.
constexpr float pixel = 0.00422f;
constexpr int wires = 22;     ///< each way
constexpr float half = 0.9f;  ///< of the grid, metres

Mesh grid() {
    Mesh mesh;
    for (int i = 0; i < wires; ++i) {
        const float t = float(i) / float(wires - 1), at = half * (2 * t - 1), radius = 0.5f * pixel * glm::mix(0.5f, 4.0f, t);
        append(mesh, bar({at, -half, 0}, {at, half, 0}, radius, 12));
        append(mesh, bar({-half, at, 0}, {half, at, 0}, radius, 12));
    }
    return mesh;
}

Glb makeWires() {
    Glb glb;
    Model model{"wires", {}};
    model.add(glb.addMaterial({.name = "wires", .color = copper, .roughness = 0.4f, .metalness = 1}), grid());
    glb.addNode(model);
    addLamp(glb, {0, 0, 0}, 1, {11, 10.2f, 9});
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeWires)

}  // namespace lodestir::generate
