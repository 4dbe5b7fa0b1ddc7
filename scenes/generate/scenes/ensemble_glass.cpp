// SPDX-License-Identifier: MIT
// Delta lobes: solid and thin-walled glass, a mirror, and a sheet that lets light straight through.
// One of the still lifes that bias is judged by (kit/still_life.h).
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "kit/metals.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/still_life.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;

Glb makeEnsembleGlass() {
    Composition c;
    const int wall = c.paint("wall", {0.74f, 0.70f, 0.64f}), floor = c.paint("floor", {0.42f, 0.30f, 0.20f}),
              left = c.paint("left", {0.20f, 0.34f, 0.50f}), right = c.paint("right", {0.70f, 0.42f, 0.20f}),
              dark = c.paint("dark", {0.06f, 0.05f, 0.05f}), petal = c.paint("petal", {0.75f, 0.12f, 0.18f}),
              stem = c.paint("stem", {0.12f, 0.36f, 0.10f});
    c.glb.addNode(chamber({}, {floor, wall, wall, wall, left, right}));
    c.glb.addNode(areaLamp("lamp", c.lamp("light", {4.2f, 4.0f, 3.7f}), wall, {0, 1.92f, 0.5f}, {0, -1, 0}, {2.2f, 1.6f}));

    const int mirror = c.gloss("mirror", silver, 0, 1);
    c.put("mirror", mirror, panel({-0.55f, 0.95f, -1.12f}, {0.12f, 0, 1}, {1.05f, 1.25f}));
    c.put("frame", dark, plainBox({1.15f, 1.35f, 0.05f}), {.translation = {-0.553f, 0.95f, -1.15f}, .rotation = turnY(6.84f)});

    const int clear = c.glb.addMaterial({.name = "crystal",
                                         .roughness = 0,
                                         .transmission = 1,
                                         .ior = 1.5f,
                                         .thickness = 0.5f,
                                         .attenuation = {0.55f, 0.88f, 0.80f},
                                         .attenuationDistance = 0.5f});
    c.ball("crystal", clear, 0.27f, {0.12f, 0, 0.25f}, 32);
    const int thin = c.glb.addMaterial({.name = "bell jar", .color = {0.93f, 0.97f, 0.98f}, .roughness = 0, .transmission = 1});
    std::vector<glm::vec2> dome;
    for (int i = 0; i <= 8; ++i)
        dome.push_back({0.27f * std::sin(tau / 4 * float(i) / 8), 0.55f + 0.27f * std::cos(tau / 4 * float(i) / 8)});
    dome.push_back({0.27f, 0.003f});
    c.put("bell_jar", thin, turned(dome, 28, 60), {.translation = {-0.55f, 0.12f, -0.2f}});
    const glm::vec2 base[] = {{0, 0.12f}, {0.31f, 0.12f}, {0.33f, 0}, {0, 0}};
    c.put("jar_base", dark, turned(base, 24), {.translation = {-0.55f, 0, -0.2f}});
    c.put("stem", stem,
          tube(std::array<Station, 3>{{{{0, 0.12f, 0}, 0.014f}, {{0.02f, 0.3f, 0}, 0.012f}, {{-0.02f, 0.5f, 0.01f}, 0.012f}}}, 8),
          {.translation = {-0.55f, 0, -0.2f}});
    c.put("flower", petal, gem(7),
          {.translation = {-0.57f, 0.6f, -0.19f}, .rotation = glm::angleAxis(0.4f, glm::vec3(1, 0, 0)), .scale = {0.13f, 0.11f, 0.13f}});

    const int veil = c.glb.addMaterial({.name = "veil", .color = {0.85f, 0.35f, 0.08f}, .alpha = 0.45f, .ior = 1});
    c.put("veil", veil, panel({0.85f, 0.5f, 0.02f}, {-0.55f, 0, 1}, {0.6f, 0.96f}));
    c.ball("behind", left, 0.24f, {0.95f, 0, -0.5f});
    c.block("cube", petal, {0.22f, 0.22f, 0.22f}, {0.5f, 0, -0.62f}, 30);
    return std::move(c.glb);
}

}  // namespace

LODESTIR_SCENE(makeEnsembleGlass)

}  // namespace lodestir::generate
