// SPDX-License-Identifier: MIT
// A terrace under the sky: a trellis of thin rods, blades of grass, glazed and polished things.
// One of the still lifes that bias is judged by (kit/still_life.h).
#include <cmath>
#include <numbers>
#include <utility>

#include "kit/grass.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/still_life.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;

Glb makeEnsembleEnvironment() {
    Composition c;
    const int stone = c.paint("stone", {0.46f, 0.42f, 0.37f}), joint = c.paint("ground", {0.20f, 0.19f, 0.13f}),
              iron = c.gloss("iron", {0.05f, 0.055f, 0.06f}, 0.4f), clay = c.paint("terracotta", {0.58f, 0.22f, 0.11f}),
              wall = c.paint("wall", {0.72f, 0.66f, 0.56f});
    c.put("ground", joint, rectangle({-30, -0.05f, -30}, {60, 0, 0}, {0, 0, 60}));
    for (int x = -3; x < 3; ++x)
        for (int z = -2; z < 3; ++z)
            c.put("slab", stone, plainBox({0.78f, 0.05f, 0.78f}), {.translation = {0.8f * (float(x) + 0.5f), -0.025f, 0.8f * float(z)}});

    Model trellis{"trellis", {}};
    for (int i = 0; i <= 10; ++i) {
        const float x = -1.9f + 0.22f * float(i);
        trellis.add(iron, bar({x, 0, -0.9f}, {x, 1.15f + 0.25f * std::sin(tau / 2 * float(i) / 10), -0.9f}, 0.011f, 5));
    }
    for (float y : {0.12f, 0.62f, 1.12f}) trellis.add(iron, bar({-1.95f, y, -0.88f}, {0.35f, y, -0.88f}, 0.011f, 5));
    c.glb.addNode(trellis);
    c.block("pillar", wall, {0.5f, 1.5f, 0.5f}, {1.35f, 0, -0.85f}, 12);
    c.block("capital", stone, {0.64f, 0.08f, 0.64f}, {1.35f, 1.5f, -0.85f}, 12);

    const glm::vec2 pot[] = {{0, 0.85f}, {0.46f, 0.85f}, {0.46f, 1}, {0.56f, 1}, {0.56f, 0.8f}, {0.5f, 0.78f}, {0.36f, 0}, {0, 0}};
    c.put("pot", clay, turned(pot, 20), {.translation = {-0.95f, 0, -0.1f}, .scale = glm::vec3(0.4f)});
    const int blade = c.glb.addMaterial({.name = "grass", .roughness = 0.7f});
    c.put("grass", blade, grassTuft(5, {.blades = 60, .height = 0.55f, .radius = 0.13f, .dryness = 0.25f}),
          {.translation = {-0.95f, 0.33f, -0.1f}});
    c.put("jug", c.gloss("glaze", {0.05f, 0.20f, 0.42f}, 0.16f), jug(18), {.translation = {0.45f, 0, -0.25f}, .scale = glm::vec3(0.78f)});
    c.ball("bronze", c.gloss("bronze", {0.78f, 0.50f, 0.26f}, 0.24f, 1), 0.24f, {0.0f, 0, 0.35f}, 20);
    c.put("hoop", iron, knot(48, 5, 0.07f), {.translation = {0.95f, 0.2f, 0.35f}, .rotation = turnY(20), .scale = glm::vec3(0.27f)});
    c.put("quartz", c.gloss("quartz", {0.75f, 0.55f, 0.58f}, 0.5f), gem(6),
          {.translation = {-0.42f, 0.16f, 0.62f}, .rotation = glm::angleAxis(2.5f, glm::vec3(1, 0, 0.3f)), .scale = glm::vec3(0.15f)});
    return std::move(c.glb);
}

}  // namespace

LODESTIR_SCENE(makeEnsembleEnvironment)

}  // namespace lodestir::generate
