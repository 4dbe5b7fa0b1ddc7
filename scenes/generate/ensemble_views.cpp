// SPDX-License-Identifier: MIT
// Still lifes to judge bias by, of what happens between light, things and camera: an open sky, motion, panes, a lens. Metres.
#include <cmath>
#include <numbers>
#include <vector>

#include "grass.h"
#include "random.h"
#include "scenes.h"
#include "shapes.h"
#include "still_life.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;

Mesh bar(const glm::vec3& from, const glm::vec3& to, float radius, int sides = 6) {
    const Station stations[] = {{from, radius}, {to, radius}};
    return tube(stations, sides);
}

/// A terrace under the sky: a trellis of thin rods, blades of grass, glazed and polished things.
void writeEnvironment(const std::filesystem::path& folder) {
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
    c.glb.write(folder / "ensemble_environment.glb");
}

/// Forty frames of a loop at 24 frames a second: `at(turn)` for turn from 0 to 1, which must meet.
template <class At> void loop(Glb& glb, int node, Motion motion, const At& at) {
    constexpr int frames = 40;
    std::vector<float> seconds;
    std::vector<glm::vec4> values;
    for (int i = 0; i <= frames; ++i) {
        seconds.push_back(float(i) / 24);
        values.push_back(at(float(i) / frames));
    }
    glb.animate(node, motion, seconds, values);
}

glm::vec4 asVector(const glm::quat& q) { return {q.x, q.y, q.z, q.w}; }

/// A lantern on a cord, three rods of a toy that tumbles along a circle, and columns whose shadows follow the lantern.
void writeMoving(const std::filesystem::path& folder) {
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
    loop(c.glb, swing, Motion::rotation, [](float t) {
        return asVector(glm::angleAxis(0.72f * std::sin(tau * t), glm::vec3(0, 0, 1)) *
                        glm::angleAxis(0.3f * std::cos(tau * t), glm::vec3(1, 0, 0)));
    });

    Model toy{"toy", {}};
    toy.add(c.paint("red", {0.72f, 0.10f, 0.06f}), roundedBox({0.62f, 0.13f, 0.13f}, 0.03f));
    toy.add(c.paint("yellow", {0.82f, 0.55f, 0.06f}), roundedBox({0.13f, 0.62f, 0.13f}, 0.03f));
    toy.add(c.gloss("blue", {0.06f, 0.22f, 0.60f}, 0.3f), roundedBox({0.13f, 0.13f, 0.62f}, 0.03f));
    const int tumble = c.glb.addNode(toy, {.translation = {0.95f, 0.42f, 0.15f}});
    loop(c.glb, tumble, Motion::translation, [](float t) {
        return glm::vec4(0.95f * std::cos(tau * t), 0.42f + 0.12f * std::sin(2 * tau * t), 0.15f + 0.4f * std::sin(tau * t), 0);
    });
    loop(c.glb, tumble, Motion::rotation, [](float t) {
        return asVector(glm::angleAxis(2 * tau * t, glm::normalize(glm::vec3(0.3f, 1, 0.2f))) * glm::angleAxis(0.6f, glm::vec3(1, 0, 0)));
    });
    c.ball("ball", c.gloss("pearl", {0.75f, 0.68f, 0.60f}, 0.35f), 0.17f, {0, 0, 0.15f}, 20);
    c.glb.write(folder / "ensemble_moving.glb");
}

/// A yard at night behind panes: a candle, a spot and the moon shine through veils that swing and tinted glass that slides.
void writePanes(const std::filesystem::path& folder) {
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
    loop(c.glb, first, Motion::rotation, [](float t) { return asVector(glm::angleAxis(0.5f * std::sin(tau * t), glm::vec3(1, 0, 0))); });
    const int second = c.put("smoke_veil", smoke, panel({0, -0.35f, 0}, {0, 0, 1}, {0.8f, 0.7f}), {.translation = {0.5f, 1.6f, -0.3f}, .rotation = turnY(-20)});
    loop(c.glb, second, Motion::translation, [](float t) { return glm::vec4(0.5f + 0.3f * std::sin(tau * t), 1.6f, -0.3f, 0); });
    const int tinted = c.glb.addMaterial({.name = "tinted glass", .color = {0.35f, 0.85f, 0.60f}, .roughness = 0, .transmission = 1});
    const int slide = c.put("glass", tinted, panel({0, 0, 0}, {0.3f, 1, 0.4f}, {1.3f, 1.1f}), {.translation = {0.3f, 1.75f, 0.3f}});
    loop(c.glb, slide, Motion::translation, [](float t) { return glm::vec4(0.3f - 0.4f * std::sin(tau * t), 1.75f, 0.3f, 0); });

    using Kind = LightSource::Kind;
    c.glb.addNode(LightSource{.name = "candle", .kind = Kind::point, .color = {1, 0.62f, 0.25f}, .intensity = 1.2f}, {.translation = {-0.3f, 1.1f, 0.9f}});
    c.glb.addNode(LightSource{.name = "spot", .kind = Kind::spot, .color = {0.75f, 0.9f, 1}, .intensity = 9.0f, .innerDegrees = 14, .outerDegrees = 24},
                  {.translation = {1.1f, 2.6f, 1.2f}, .rotation = turnTo({-0.5f, -2.4f, -1.5f})});
    c.glb.addNode(LightSource{.name = "moon", .kind = Kind::directional, .color = {0.45f, 0.6f, 1}, .intensity = 0.9f}, {.rotation = turnTo({-0.35f, -1, -0.45f})});
    c.glb.write(folder / "ensemble_panes.glb");
}

/// A long table of skittles from near to far, and lamps that blur into discs behind it.
void writeLens(const std::filesystem::path& folder) {
    Composition c;
    const Chamber hall{.halfWidth = 2.2f, .height = 2.4f, .back = -6, .front = 3.4f};
    const int wall = c.paint("wall", {0.26f, 0.32f, 0.40f}), ceiling = c.paint("ceiling", {0.66f, 0.64f, 0.60f}),
              back = c.paint("back", {0.16f, 0.18f, 0.26f}), light = c.paint("light tile", {0.70f, 0.64f, 0.54f}),
              dark = c.paint("dark tile", {0.13f, 0.09f, 0.07f});
    c.glb.addNode(chamber(hall, {dark, ceiling, back, wall, wall, wall}));
    Model tiles{"tiles", {}};  // a hair above the dark floor
    constexpr float side = 0.44f;
    for (int x = 0; x < 10; ++x)
        for (int z = (x & 1); z < 20; z += 2)
            tiles.add(light, rectangle({-2.2f + side * float(x), 0.002f, -5.4f + side * float(z)}, {side, 0, 0}, {0, 0, side}));
    c.glb.addNode(tiles);
    c.glb.addNode(areaLamp("key", c.lamp("key light", {7.5f, 7.0f, 6.2f}), ceiling, {0.2f, 2.3f, 0.6f}, {0, -1, 0}, {1.8f, 1.6f}));

    const glm::vec2 skittle[] = {{0, 1},         {0.1f, 0.96f},  {0.135f, 0.87f}, {0.07f, 0.72f},
                                 {0.11f, 0.55f}, {0.19f, 0.28f}, {0.13f, 0},      {0, 0}};
    const Mesh pin = lathe(skittle, 2, 16);
    const glm::vec3 colors[] = {
        {0.72f, 0.12f, 0.07f}, {0.80f, 0.52f, 0.08f}, {0.10f, 0.42f, 0.38f}, {0.70f, 0.66f, 0.58f}, {0.42f, 0.12f, 0.30f}};
    const glm::vec3 places[] = {{-0.42f, 0, 1.45f}, {0.42f, 0, 0.75f}, {-0.30f, 0, -0.1f}, {0.62f, 0, -1.3f}, {-0.62f, 0, -2.9f}};
    for (int i = 0; i < 5; ++i)
        c.put("skittle", c.gloss("skittle_" + std::to_string(i), colors[i], 0.3f + 0.05f * float(i)), pin,
              {.translation = places[i], .scale = glm::vec3(0.85f)});

    const glm::vec3 hues[] = {{1, 0.55f, 0.2f}, {1, 0.8f, 0.5f}, {0.9f, 0.3f, 0.25f}, {0.45f, 0.7f, 1}};
    Random random(3);
    int lamps[4];
    for (int i = 0; i < 4; ++i) lamps[i] = c.lamp("bulb_" + std::to_string(i), hues[i] * 7.0f);
    for (int i = 0; i < 12; ++i)
        c.put("bulb", lamps[i % 4], sphere(8, 4),
              {.translation = {-1.75f + 0.32f * float(i), 1.15f + random.between(-0.35f, 0.75f), random.between(-5.2f, -4.4f)},
               .scale = glm::vec3(0.065f)});
    c.put("floor_bulb", lamps[1], sphere(10, 6), {.translation = {0.1f, 0.07f, 0.5f}, .scale = glm::vec3(0.07f)});
    c.glb.write(folder / "ensemble_lens.glb");
}

void writeEnsembleViews(const std::filesystem::path& folder) {
    writeEnvironment(folder);
    writeMoving(folder);
    writePanes(folder);
    writeLens(folder);
}

}  // namespace

LODESTIR_SCENE(ensemble_views, writeEnsembleViews)

}  // namespace lodestir::generate
