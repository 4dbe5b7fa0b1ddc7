// SPDX-License-Identifier: MIT
// A rabbit that bows and stretches: its mesh deforms in every frame, and has levels. One of the still lifes that bias is judged by (kit/still_life.h).
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "kit/motion.h"
#include "kit/rabbit.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/still_life.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;

/// The rabbit's way down, of its own metres: forward along +x over its feet, which stay, and a little to its side.
glm::vec3 bowed(const glm::vec3& p) {
    const float t = p.y / 0.45f, angle = 1.15f * t * t;
    const glm::vec3 low(p.x + 0.13f * t * std::sin(angle), p.y * (1 - 0.34f * t), p.z * (1 + 0.30f * t * (1 - t)));
    return low + glm::vec3(0, 0, 0.07f * t * t);
}

void addRabbit(Composition& c) {
    const Model sitting = rabbit(c.glb, "rabbit", 0.0095f);
    const auto& [coat, mesh] = sitting.parts[0];
    std::vector<glm::vec3> down;
    for (const Vertex& v : mesh.vertices) down.push_back(bowed(v.position));
    const int node = c.glb.addNode("rabbit", c.glb.addMesh("rabbit", {{c.glb.addGeometry(mesh, down), coat}}),
                                   {.translation = {-0.12f, 0.16f, -0.1f}, .rotation = turnY(-38), .scale = glm::vec3(2.1f)});
    animate(c.glb, node, Motion::weight, loopPieces, [](float t) { return glm::vec4(0.5f + 0.5f * std::sin(tau * t), 0, 0, 0); });
}

Glb makeEnsembleBending() {
    Composition c;
    const int wall = c.paint("wall", {0.58f, 0.60f, 0.56f}), floor = c.paint("floor", {0.52f, 0.44f, 0.34f}), left = c.paint("left", {0.50f, 0.22f, 0.16f}),
              right = c.paint("right", {0.18f, 0.36f, 0.33f}), chalk = c.paint("chalk", {0.78f, 0.76f, 0.72f}), leaf = c.paint("leaf", {0.24f, 0.40f, 0.10f}),
              root = c.paint("root", {0.80f, 0.36f, 0.06f}), glaze = c.gloss("glaze", {0.10f, 0.24f, 0.42f}, 0.3f);
    c.glb.addNode(chamber({}, {floor, wall, wall, wall, left, right}));
    c.glb.addNode(areaLamp("lamp", c.lamp("light", {10.5f, 9.4f, 7.8f}), wall, {-0.5f, 1.9f, 0.5f}, {0.15f, -1, -0.2f}, {1.0f, 0.8f}));
    c.block("stage", chalk, {1.5f, 0.16f, 0.9f}, {0, 0, -0.1f}, 6);
    addRabbit(c);
    // A carrot that it bows to.
    const glm::vec2 carrot[] = {{0, 0.32f}, {0.05f, 0.31f}, {0.065f, 0.25f}, {0.03f, 0.08f}, {0, 0}};
    const Placement lying{.translation = {0.50f, 0.22f, 0.36f}, .rotation = turnY(35) * glm::angleAxis(-1.5f, glm::vec3(0, 0, 1))};
    c.put("carrot", root, turned(carrot, 12, 60), lying);
    const glm::mat4 stand = glm::translate(glm::mat4(1), lying.translation) * glm::mat4_cast(lying.rotation);
    for (float side : {-0.05f, 0.0f, 0.05f})
        c.put("green", leaf, bar(glm::vec3(stand * glm::vec4(0, 0.31f, 0, 1)), glm::vec3(stand * glm::vec4(side, 0.46f, side / 2, 1)), 0.012f, 5));
    c.put("jug", glaze, jug(20), {.translation = {-0.95f, 0, -0.55f}, .scale = glm::vec3(0.72f)});
    return std::move(c.glb);
}

}  // namespace

LODESTIR_SCENE(makeEnsembleBending, "--levels 3 --ratio 4 --mesh rabbit")

}  // namespace lodestir::generate
