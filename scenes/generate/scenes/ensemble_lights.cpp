// SPDX-License-Identifier: MIT
// A yard at night, open to the sky: forty glowing pennants, a point light, a spot and the moon.
// One of the still lifes that bias is judged by (kit/still_life.h).
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "kit/random.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/still_life.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;

Glb makeEnsembleLights() {
    Composition c;
    const int wall = c.paint("wall", {0.62f, 0.56f, 0.50f}), floor = c.paint("floor", {0.46f, 0.42f, 0.38f}),
              wood = c.paint("wood", {0.48f, 0.27f, 0.13f}), linen = c.paint("linen", {0.75f, 0.72f, 0.66f}),
              glaze = c.gloss("glaze", {0.08f, 0.22f, 0.42f}, 0.35f), fruit = c.paint("fruit", {0.78f, 0.36f, 0.05f});
    constexpr float l = -1.9f, r = 1.9f, b = -1.3f, f = 3.0f, h = 2.3f;
    c.put("floor", floor, rectangle({l, 0, b}, {r - l, 0, 0}, {0, 0, f - b}));
    c.put("back", wall, rectangle({l, h, b}, {r - l, 0, 0}, {0, -h, 0}));
    c.put("left", wall, rectangle({l, h, f}, {0, 0, b - f}, {0, -h, 0}));
    c.put("right", wall, rectangle({r, h, b}, {0, 0, f - b}, {0, -h, 0}));

    // Pennants hang from three lines; their hues go around the circle, their powers span a factor of six.
    Random random(17);
    std::vector<int> dyes;
    for (int i = 0; i < 10; ++i) {
        glm::vec3 hue;
        for (int k = 0; k < 3; ++k) hue[k] = 0.5f + 0.5f * std::cos(tau * (float(i) / 10 - float(k) / 3));
        Material dye = glow("dye_" + std::to_string(i), (0.03f + hue * hue) * std::exp2(random.between(0, 2.6f)) * 2.0f);
        dye.doubleSided = true;
        dyes.push_back(c.glb.addMaterial(dye));
    }
    Model bunting{"bunting", {}};
    const glm::vec3 lines[3][2] = {{{-1.75f, 1.95f, -0.75f}, {1.75f, 1.75f, -0.7f}},
                                   {{-1.75f, 1.8f, -0.2f}, {1.75f, 1.95f, 0.2f}},
                                   {{-1.75f, 1.95f, 0.6f}, {1.75f, 1.9f, 0.85f}}};
    for (int i = 0; i < 40; ++i) {
        const auto& line = lines[i % 3];
        const float t = (float(i / 3) + 0.5f) / 14;
        const glm::vec3 at = glm::mix(line[0], line[1], t) - glm::vec3(0, 1.3f * t * (1 - t), 0);
        const float size = random.between(0.13f, 0.19f), turn = random.between(-0.5f, 0.5f);
        const glm::vec3 right = glm::vec3(std::cos(turn), 0, -std::sin(turn)) * (size / 2);
        Mesh flag;
        flag.add({.position = at - right, .normal = {0, 0, 1}, .uv = {0, 0}});
        flag.add({.position = at - glm::vec3(0, size * 1.2f, 0), .normal = {0, 0, 1}, .uv = {0.5f, 1}});
        flag.add({.position = at + right, .normal = {0, 0, 1}, .uv = {1, 0}});
        flag.triangle(0, 1, 2);
        bunting.add(dyes[size_t(random.below(10))], faceted(flag));
    }
    c.glb.addNode(bunting);

    c.block("table_top", wood, {1.5f, 0.05f, 0.8f}, {-0.15f, 0.5f, -0.15f}, 6);
    for (float x : {-0.78f, 0.48f})
        for (float z : {-0.42f, 0.12f}) c.block("leg", wood, {0.06f, 0.5f, 0.06f}, {x, 0, z}, 6);
    c.put("jug", glaze, jug(20), {.translation = {-0.5f, 0.55f, -0.2f}, .scale = glm::vec3(0.42f)});
    c.put("dish", linen, dish(20), {.translation = {0.15f, 0.55f, -0.1f}, .scale = glm::vec3(0.14f)});
    const glm::vec3 heap[] = {{0.09f, 0.59f, -0.07f}, {0.21f, 0.59f, -0.13f}, {0.16f, 0.68f, -0.1f}};
    for (const glm::vec3& at : heap) c.ball("orange", fruit, 0.06f, at, 12);
    c.block("crate", wood, {0.5f, 0.42f, 0.42f}, {1.15f, 0, -0.5f}, -24);
    c.ball("globe", linen, 0.2f, {1.15f, 0.42f, -0.5f}, 20);

    using Kind = LightSource::Kind;
    c.glb.addNode(LightSource{.name = "candle", .kind = Kind::point, .color = {1, 0.62f, 0.25f}, .intensity = 0.9f},
                  {.translation = {-0.12f, 0.95f, 0.1f}});
    c.glb.addNode(
        LightSource{
            .name = "spot", .kind = Kind::spot, .color = {0.75f, 0.9f, 1}, .intensity = 8.0f, .innerDegrees = 12, .outerDegrees = 21},
        {.translation = {1.5f, 2.3f, 1.3f}, .rotation = turnTo({-0.3f, -1.9f, -1.7f})});
    c.glb.addNode(LightSource{.name = "moon", .kind = Kind::directional, .color = {0.45f, 0.6f, 1}, .intensity = 0.6f},
                  {.rotation = turnTo({0.5f, -1, -0.55f})});
    return std::move(c.glb);
}

}  // namespace

LODESTIR_SCENE(makeEnsembleLights)

}  // namespace lodestir::generate
