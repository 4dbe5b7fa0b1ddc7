// SPDX-License-Identifier: MIT
// A closed room of coloured chalk: nothing but diffuse reflection, half of the light indirect.
// One of the still lifes that bias is judged by (kit/still_life.h).
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/still_life.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;

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

Glb makeEnsembleDiffuse() {
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
    return std::move(c.glb);
}

}  // namespace

LODESTIR_SCENE(makeEnsembleDiffuse)

}  // namespace lodestir::generate
