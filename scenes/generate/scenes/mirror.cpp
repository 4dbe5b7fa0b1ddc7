// SPDX-License-Identifier: MIT
// A knot of polished gold by itself: a flat bar that winds twice around, thrice through itself, and twists on its way. Nothing but reflections.
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "kit/backdrop.h"
#include "kit/metals.h"
#include "kit/scene.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;
constexpr int stations = 960, sides = 72;  ///< 138,240 triangles
constexpr float around = 2, through = 3, ring = 0.62f, winding = 0.27f;
constexpr glm::vec2 section(0.205f, 0.105f);  ///< half axes
constexpr float halfTwists = 3;               ///< odd: the bar's broad side comes back as its other one

/// A point of the bar: t along, phi around it.
glm::vec3 knotAt(float t, float phi) {
    const auto centre = [](float s) {
        const float r = ring + winding * std::cos(through * s);
        return glm::vec3(r * std::cos(around * s), winding * 1.15f * std::sin(through * s), r * std::sin(around * s));
    };
    // The normal of the torus that the knot winds on: this frame closes where the curve does.
    const glm::vec3 out(std::cos(through * t) * std::cos(around * t), std::sin(through * t), std::cos(through * t) * std::sin(around * t));
    const glm::vec3 along = glm::normalize(centre(t + 0.001f) - centre(t - 0.001f)), up = glm::normalize(out - along * glm::dot(out, along)),
                    side = glm::cross(up, along);
    const float twist = 0.5f * halfTwists * t;
    const glm::vec2 p = section * glm::vec2(std::cos(phi), std::sin(phi));
    return centre(t) + (p.x * std::cos(twist) - p.y * std::sin(twist)) * side + (p.x * std::sin(twist) + p.y * std::cos(twist)) * up;
}

Mesh knot() {
    Mesh mesh;
    for (int i = 0; i <= stations; ++i)
        for (int k = 0; k <= sides; ++k) {
            // The last ring is the first, half a turn on: bit for bit.
            const int place = (k + (i == stations ? int(halfTwists) * sides / 2 : 0)) % sides;
            mesh.add({.position = knotAt(tau * float(i % stations) / float(stations), tau * float(place) / float(sides)),
                      .uv = {float(i) / float(stations), float(k) / float(sides)}});
        }
    for (int i = 0; i < stations; ++i)
        for (int k = 0; k < sides; ++k) {
            const auto a = uint32_t(i * (sides + 1) + k), next = uint32_t(sides + 1);
            mesh.quad(a, a + 1, a + next + 1, a + next);
        }
    computeNormals(mesh, 180);
    return mesh;
}

Glb makeMirror() {
    Glb glb;
    Model model{"mirror", {}};
    model.add(glb.addMaterial({.name = "mirror", .color = gold, .roughness = 0.05f, .metalness = 1}), knot());
    glb.addNode(model, {.rotation = glm::angleAxis(glm::radians(62.0f), glm::normalize(glm::vec3(1, 0.1f, -0.25f)))});
    addLamp(glb, {0, 0, 0}, 1.05f, {14, 12.5f, 10});
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeMirror, "--levels 4 --mesh mirror")

}  // namespace lodestir::generate
