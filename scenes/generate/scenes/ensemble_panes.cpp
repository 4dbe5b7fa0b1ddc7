// SPDX-License-Identifier: MIT
// A yard at night behind panes: a candle, a spot and the moon shine through veils that swing and tinted glass that slides.
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

Glb makeEnsemblePanes() {
    Composition c;
    const int wall = c.paint("wall", {0.62f, 0.56f, 0.50f}), floor = c.paint("floor", {0.46f, 0.42f, 0.38f}), clay = c.paint("clay", {0.60f, 0.26f, 0.14f}),
              glaze = c.gloss("glaze", {0.08f, 0.22f, 0.42f}, 0.35f);
    constexpr float l = -1.7f, r = 1.7f, b = -1.2f, f = 2.8f, h = 2.0f;
    c.put("floor", floor, rectangle({l, 0, b}, {r - l, 0, 0}, {0, 0, f - b}));
    c.put("back", wall, rectangle({l, h, b}, {r - l, 0, 0}, {0, -h, 0}));
    c.put("left", wall, rectangle({l, h, f}, {0, 0, b - f}, {0, -h, 0}));
    c.put("right", wall, rectangle({r, h, b}, {0, 0, f - b}, {0, -h, 0}));
    c.block("block", clay, {0.45f, 0.6f, 0.45f}, {-0.75f, 0, -0.6f}, 25);
    c.ball("ball", glaze, 0.24f, {0.75f, 0, -0.35f}, 20);

    // The veils' nodes are their rods.
    const int amber = c.glb.addMaterial({.name = "amber veil", .color = {0.85f, 0.45f, 0.10f}, .alpha = 0.45f, .ior = 1, .doubleSided = true}),
              smoke = c.glb.addMaterial({.name = "smoke veil", .color = {0.30f, 0.32f, 0.36f}, .alpha = 0.7f, .roughness = 0.4f, .doubleSided = true});
    const int first = c.put("amber_veil", amber, panel({0, -0.45f, 0}, {0, 0, 1}, {1.0f, 0.9f}), {.translation = {-0.45f, 1.7f, -0.05f}});
    animate(c.glb, first, Motion::rotation, loopPieces, [](float t) { return asVector(glm::angleAxis(0.5f * std::sin(tau * t), glm::vec3(1, 0, 0))); });
    const int second = c.put("smoke_veil", smoke, panel({0, -0.35f, 0}, {0, 0, 1}, {0.8f, 0.7f}), {.translation = {0.5f, 1.6f, -0.3f}, .rotation = turnY(-20)});
    animate(c.glb, second, Motion::translation, loopPieces, [](float t) { return glm::vec4(0.5f + 0.3f * std::sin(tau * t), 1.6f, -0.3f, 0); });
    const int tinted = c.glb.addMaterial({.name = "tinted glass", .color = {0.35f, 0.85f, 0.60f}, .roughness = 0, .transmission = 1});
    const int slide = c.put("glass", tinted, panel({0, 0, 0}, {0.3f, 1, 0.4f}, {1.3f, 1.1f}), {.translation = {0.3f, 1.75f, 0.3f}});
    animate(c.glb, slide, Motion::translation, loopPieces, [](float t) { return glm::vec4(0.3f - 0.4f * std::sin(tau * t), 1.75f, 0.3f, 0); });

    using Kind = LightSource::Kind;
    c.glb.addNode(LightSource{.name = "candle", .kind = Kind::point, .color = {1, 0.62f, 0.25f}, .intensity = 1.2f}, {.translation = {-0.3f, 1.1f, 0.9f}});
    c.glb.addNode(LightSource{.name = "spot", .kind = Kind::spot, .color = {0.75f, 0.9f, 1}, .intensity = 9.0f, .innerDegrees = 14, .outerDegrees = 24},
                  {.translation = {1.1f, 2.6f, 1.2f}, .rotation = turnTo({-0.5f, -2.4f, -1.5f})});
    c.glb.addNode(LightSource{.name = "moon", .kind = Kind::directional, .color = {0.45f, 0.6f, 1}, .intensity = 0.9f},
                  {.rotation = turnTo({-0.35f, -1, -0.45f})});
    return std::move(c.glb);
}

}  // namespace

LODESTIR_SCENE(makeEnsemblePanes)

}  // namespace lodestir::generate
