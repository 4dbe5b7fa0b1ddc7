// SPDX-License-Identifier: MIT
// Still lifes in rooms to judge bias by: each stresses one mechanism of path reuse, is cheap to trace and converges fast, for all its
// lamps are broad. Metres.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "random.h"
#include "scenes.h"
#include "shapes.h"
#include "still_life.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;

/// Linear Rec.709 reflectance at normal incidence.
constexpr glm::vec3 gold{1.0f, 0.77f, 0.34f}, copper{0.95f, 0.64f, 0.54f}, steel{0.56f, 0.57f, 0.58f}, silver{0.93f, 0.92f, 0.89f};

/// A round arch on two piers: `width` across, one unit high, half a unit deep, cut into `steps`.
Mesh arch(float width, int steps) {
    std::vector<glm::vec2> inner, outer;
    const float ring = width * 0.28f, radius = width / 2 - ring, spring = 1 - width / 2;
    inner.push_back({radius, 0});
    outer.push_back({width / 2, 0});
    for (int i = 0; i <= steps; ++i) {
        const float a = tau / 2 * float(i) / float(steps);
        inner.push_back({radius * std::cos(a), spring + radius * std::sin(a)});
        outer.push_back({width / 2 * std::cos(a), spring + width / 2 * std::sin(a)});
    }
    inner.push_back({-radius, 0});
    outer.push_back({-width / 2, 0});
    Mesh mesh;
    constexpr float depth = 0.25f;
    const auto strip = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
        const uint32_t first = mesh.add({.position = a});
        mesh.add({.position = b, .uv = {0, 1}});
        mesh.add({.position = c, .uv = {1, 1}});
        mesh.add({.position = d, .uv = {1, 0}});
        mesh.quad(first, first + 1, first + 2, first + 3);
    };
    for (size_t i = 0; i + 1 < inner.size(); ++i) {
        const glm::vec3 near(0, 0, depth), a(inner[i], 0), b(inner[i + 1], 0), c(outer[i], 0), d(outer[i + 1], 0);
        strip(a + near, c + near, d + near, b + near);  // front
        strip(c - near, a - near, b - near, d - near);  // back
        strip(c + near, c - near, d - near, d + near);  // outside
        strip(a - near, a + near, b + near, b - near);  // inside
    }
    computeNormals(mesh, 30);
    return mesh;
}

/// A closed room of coloured chalk: nothing but diffuse reflection, half of the light indirect.
void writeDiffuse(const std::filesystem::path& folder) {
    Composition c;
    const int white = c.paint("white", {0.78f, 0.75f, 0.70f}), brick = c.paint("brick", {0.68f, 0.19f, 0.10f}),
              teal = c.paint("teal", {0.09f, 0.40f, 0.42f}), sand = c.paint("sand", {0.66f, 0.52f, 0.34f}),
              ochre = c.paint("ochre", {0.80f, 0.48f, 0.10f}), plum = c.paint("plum", {0.35f, 0.12f, 0.26f});
    c.glb.addNode(chamber({}, {sand, white, white, white, brick, teal}));
    c.glb.addNode(areaLamp("lamp", c.lamp("light", {9.5f, 8.6f, 7.2f}), white, {0.1f, 1.86f, 0.3f}, {0, -1, 0}, {1.0f, 0.8f}));
    c.put("arch", white, arch(0.95f, 12), {.translation = {-0.62f, 0, -0.45f}, .rotation = turnY(22), .scale = glm::vec3(1.05f)});
    c.ball("ball", ochre, 0.19f, {-0.55f, 0, -0.28f});
    c.block("plinth", white, {0.52f, 0.62f, 0.52f}, {0.72f, 0, -0.35f}, -18);
    c.put("jug", teal, jug(20), {.translation = {0.72f, 0.62f, -0.35f}, .scale = glm::vec3(0.55f)});
    c.block("step", plum, {0.85f, 0.16f, 0.42f}, {0.45f, 0, 0.45f}, 8);
    c.block("cube", sand, {0.2f, 0.2f, 0.2f}, {0.22f, 0.16f, 0.45f}, 33);
    const glm::vec2 cone[] = {{0, 1}, {0.42f, 0}, {0, 0}};
    c.put("cone", brick, turned(cone, 24, 60), {.translation = {0.62f, 0.16f, 0.45f}, .scale = glm::vec3(0.34f)});
    c.glb.write(folder / "ensemble_diffuse.glb");
}

/// Lacquer and metal from mirror-like to satin. Reuse decides by roughness 0.2 or alpha 0.2 (roughness 0.447): things lie on both sides.
void writeGlossy(const std::filesystem::path& folder) {
    Composition c;
    const int wall = c.gloss("wall", {0.55f, 0.56f, 0.54f}, 0.5f), floor = c.gloss("floor", {0.16f, 0.10f, 0.07f}, 0.22f),
              side = c.gloss("side", {0.13f, 0.25f, 0.36f}, 0.42f), ceiling = c.gloss("ceiling", {0.7f, 0.68f, 0.64f}, 0.5f),
              tray = c.gloss("tray", glm::vec3(0.1f), 0.5f);
    c.glb.addNode(chamber({}, {floor, ceiling, wall, wall, side, side}));
    c.glb.addNode(
        areaLamp("warm", c.lamp("warm light", {4.6f, 3.6f, 2.5f}), tray, {-1.1f, 1.62f, 0.7f}, {0.75f, -0.9f, -0.35f}, {1.2f, 1.15f}));
    c.glb.addNode(
        areaLamp("cool", c.lamp("cool light", {2.3f, 3.1f, 4.3f}), tray, {1.2f, 1.5f, 0.5f}, {-0.9f, -0.8f, -0.2f}, {1.1f, 1.2f}));
    c.put("jug", c.gloss("gold", gold, 0.18f, 1), jug(18), {.translation = {-0.62f, 0, -0.25f}, .scale = glm::vec3(0.95f)});
    c.put("knot", c.gloss("copper", copper, 0.40f, 1), knot(48, 8, 0.17f),
          {.translation = {0.62f, 0.44f, -0.4f}, .rotation = glm::angleAxis(1.15f, glm::vec3(1, 0, 0.2f)), .scale = glm::vec3(0.46f)});
    c.put("dish", c.gloss("steel", steel, 0.30f, 1), dish(16), {.translation = {0.12f, 0, 0.32f}, .scale = glm::vec3(0.22f)});
    c.ball("lacquer", c.gloss("lacquer", {0.62f, 0.03f, 0.03f}, 0.05f), 0.135f, {0.1f, 0.05f, 0.32f}, 18);
    c.ball("satin", c.gloss("satin", {0.10f, 0.42f, 0.20f}, 0.45f), 0.15f, {-0.42f, 0, 0.55f}, 18);
    c.ball("silk", c.gloss("silk", {0.80f, 0.50f, 0.06f}, 0.21f), 0.12f, {0.68f, 0, 0.52f}, 18);
    c.glb.write(folder / "ensemble_glossy.glb");
}

/// Surfaces in layers: lacquered boards, a coat as clear as glass on rough metal, brushed metal, velvet and a tinted gloss.
void writeLayers(const std::filesystem::path& folder) {
    Composition c;
    const int wall = c.glb.addMaterial({.name = "damask", .color = {0.45f, 0.42f, 0.38f}, .roughness = 0.8f, .sheen = {0.5f, 0.5f, 0.6f}, .sheenRoughness = 0.5f}),
              floor = c.glb.addMaterial({.name = "boards", .color = {0.30f, 0.17f, 0.09f}, .roughness = 0.6f, .coat = 0.8f, .coatRoughness = 0.3f}),
              side = c.glb.addMaterial({.name = "side", .color = {0.13f, 0.25f, 0.36f}, .roughness = 0.42f, .specular = 0.7f, .specularColor = {4, 2, 1}}),
              ceiling = c.paint("ceiling", {0.7f, 0.68f, 0.64f}), tray = c.paint("tray", glm::vec3(0.1f));
    c.glb.addNode(chamber({}, {floor, ceiling, wall, wall, side, side}));
    c.glb.addNode(
        areaLamp("warm", c.lamp("warm light", {4.6f, 3.6f, 2.5f}), tray, {-1.1f, 1.62f, 0.7f}, {0.75f, -0.9f, -0.35f}, {1.2f, 1.15f}));
    c.glb.addNode(
        areaLamp("cool", c.lamp("cool light", {2.3f, 3.1f, 4.3f}), tray, {1.2f, 1.5f, 0.5f}, {-0.9f, -0.8f, -0.2f}, {1.1f, 1.2f}));
    const int brushed = c.glb.addMaterial({.name = "brushed", .color = gold, .roughness = 0.3f, .metalness = 1, .anisotropy = 0.7f, .anisotropyRotation = 0.4f}),
              velvet = c.glb.addMaterial({.name = "velvet", .color = {0.10f, 0.01f, 0.03f}, .roughness = 0.9f, .sheen = {0.9f, 0.25f, 0.35f}, .sheenRoughness = 0.35f}),
              glazed = c.glb.addMaterial({.name = "glazed", .color = steel, .roughness = 0.45f, .metalness = 1, .coat = 1}),
              lacquer = c.glb.addMaterial({.name = "lacquer", .color = {0.62f, 0.03f, 0.03f}, .roughness = 0.5f, .coat = 1, .coatRoughness = 0.06f}),
              pearl = c.glb.addMaterial({.name = "pearl", .color = {0.6f, 0.58f, 0.5f}, .roughness = 0.35f, .coat = 0.6f, .coatRoughness = 0.15f, .sheen = {0.2f, 0.3f, 0.4f}, .sheenRoughness = 0.6f, .anisotropy = 0.5f, .specularColor = {1, 3, 5}});
    c.put("jug", brushed, jug(18), {.translation = {-0.62f, 0, -0.25f}, .scale = glm::vec3(0.95f)});
    c.put("knot", velvet, knot(48, 8, 0.17f),
          {.translation = {0.62f, 0.44f, -0.4f}, .rotation = glm::angleAxis(1.15f, glm::vec3(1, 0, 0.2f)), .scale = glm::vec3(0.46f)});
    c.put("dish", glazed, dish(16), {.translation = {0.12f, 0, 0.32f}, .scale = glm::vec3(0.22f)});
    c.ball("lacquer", lacquer, 0.135f, {0.1f, 0.05f, 0.32f}, 18);
    c.ball("pearl", pearl, 0.15f, {-0.42f, 0, 0.55f}, 18);
    c.ball("brass", brushed, 0.12f, {0.68f, 0, 0.52f}, 18);
    c.glb.write(folder / "ensemble_layers.glb");
}

/// Delta lobes: solid and thin-walled glass, a mirror, and a sheet that lets light straight through.
void writeGlass(const std::filesystem::path& folder) {
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
    c.glb.write(folder / "ensemble_glass.glb");
}

/// A yard at night, open to the sky: forty glowing pennants, a point light, a spot and the moon.
void writeLights(const std::filesystem::path& folder) {
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
    c.glb.write(folder / "ensemble_lights.glb");
}

void writeEnsembleRooms(const std::filesystem::path& folder) {
    writeDiffuse(folder);
    writeGlossy(folder);
    writeLayers(folder);
    writeGlass(folder);
    writeLights(folder);
}

}  // namespace

LODESTIR_SCENE(ensemble_rooms, writeEnsembleRooms)

}  // namespace lodestir::generate
