// SPDX-License-Identifier: MIT
// A ring around a ball, seen along a diagonal of its box: no view of 6 looks into the gap between them.
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "kit/backdrop.h"
#include "kit/scene.h"
#include "kit/shapes.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;
constexpr float ring = 0.72f, tube = 0.28f, ball = 0.36f;

Mesh torus() {
    Mesh mesh = grid(256, 96, [](float u, float v) {
        // The seams are exact, so that the surface is closed bit for bit.
        const float a = tau * (u == 1 ? 0 : u), b = -tau * (v == 1 ? 0 : v), r = ring + tube * std::cos(b);
        return glm::vec3(r * std::sin(a), tube * std::sin(b), r * std::cos(a));
    });
    return mesh;
}

Glb makeTorus() {
    Glb glb;
    Model model{"torus", {}};
    model.add(glb.addMaterial({.name = "ring", .color = {0.08f, 0.22f, 0.40f}, .roughness = 0.3f}), torus());
    model.add(glb.addMaterial({.name = "ball", .color = {0.80f, 0.42f, 0.10f}, .roughness = 0.45f}),
              placed(sphere(128, 64), glm::scale(glm::mat4(1), glm::vec3(ball))));
    glb.addNode(model);
    addLamp(glb, {0, 0, 0}, 1, {11, 10.2f, 9});
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeTorus, "--levels 4 --mesh torus")

}  // namespace lodestir::generate
