// SPDX-License-Identifier: MIT
// A lantern on a cord, three rods of a toy that tumbles along a circle, and columns whose shadows follow the lantern.
// One of the still lifes that bias is judged by (kit/still_life.h).
#include <cmath>
#include <numbers>
#include <utility>

#include "kit/motion.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/still_life.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;

Glb makeEnsembleMoving() {
    Composition c;
    const int wall = c.paint("wall", {0.34f, 0.42f, 0.56f}), floor = c.paint("floor", {0.50f, 0.42f, 0.33f}),
              left = c.paint("left", {0.22f, 0.36f, 0.30f}), right = c.paint("right", {0.52f, 0.24f, 0.16f}),
              dark = c.paint("cord", {0.06f, 0.05f, 0.05f}), chalk = c.paint("chalk", {0.78f, 0.76f, 0.72f});
    c.glb.addNode(chamber({}, {floor, wall, wall, wall, left, right}));
    c.glb.addNode(areaLamp("fill", c.lamp("fill light", {1.0f, 1.15f, 1.35f}), wall, {0, 1.94f, 1.4f}, {0, -1, 0}, {2.2f, 1.2f}));
    const glm::vec2 column[] = {{0, 1}, {0.13f, 1}, {0.13f, 0.93f}, {0.085f, 0.9f}, {0.1f, 0.08f}, {0.14f, 0.06f}, {0.14f, 0}, {0, 0}};
    for (float x : {-1.05f, -0.35f, 0.35f, 1.05f})
        c.put("column", chalk, turned(column, 14, 40), {.translation = {x, 0, -0.75f}, .scale = {1, x * x > 1 ? 0.8f : 1.1f, 1}});

    // The lantern's node is its hook: a turn swings cord and light.
    Model lantern{"lantern", {}};
    Mesh globe = faceted(sphere(10, 6));
    for (Vertex& v : globe.vertices) v.position = 0.15f * v.position - glm::vec3(0, 0.8f, 0);
    lantern.add(c.lamp("lantern light", {10, 6.4f, 3.2f}), globe);
    lantern.add(dark, bar({0, 0, 0}, {0, -0.66f, 0}, 0.008f, 4));
    const int swing = c.glb.addNode(lantern, {.translation = {0, 1.99f, -0.05f}});
    animate(c.glb, swing, Motion::rotation, loopPieces, [](float t) {
        return asVector(glm::angleAxis(0.72f * std::sin(tau * t), glm::vec3(0, 0, 1)) *
                        glm::angleAxis(0.3f * std::cos(tau * t), glm::vec3(1, 0, 0)));
    });

    Model toy{"toy", {}};
    toy.add(c.paint("red", {0.72f, 0.10f, 0.06f}), roundedBox({0.62f, 0.13f, 0.13f}, 0.03f));
    toy.add(c.paint("yellow", {0.82f, 0.55f, 0.06f}), roundedBox({0.13f, 0.62f, 0.13f}, 0.03f));
    toy.add(c.gloss("blue", {0.06f, 0.22f, 0.60f}, 0.3f), roundedBox({0.13f, 0.13f, 0.62f}, 0.03f));
    const int tumble = c.glb.addNode(toy, {.translation = {0.95f, 0.42f, 0.15f}});
    animate(c.glb, tumble, Motion::translation, loopPieces, [](float t) {
        return glm::vec4(0.95f * std::cos(tau * t), 0.42f + 0.12f * std::sin(2 * tau * t), 0.15f + 0.4f * std::sin(tau * t), 0);
    });
    animate(c.glb, tumble, Motion::rotation, loopPieces, [](float t) {
        return asVector(glm::angleAxis(2 * tau * t, glm::normalize(glm::vec3(0.3f, 1, 0.2f))) * glm::angleAxis(0.6f, glm::vec3(1, 0, 0)));
    });
    c.ball("ball", c.gloss("pearl", {0.75f, 0.68f, 0.60f}, 0.35f), 0.17f, {0, 0, 0.15f}, 20);
    return std::move(c.glb);
}

}  // namespace

LODESTIR_SCENE(makeEnsembleMoving)

}  // namespace lodestir::generate
