// SPDX-License-Identifier: MIT
// A knot of neon on a plinth and pleated paper lamps: all that glows has levels, of triangles that lie elsewhere and of another area, and nothing else lights
// the room. One of the still lifes that bias is judged by (kit/still_life.h).
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/still_life.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;

/// A globe of paper in sharp pleats, open at its poles, about 1 in radius.
Mesh pleated(int pleats, int rows) {
    return faceted(grid(2 * pleats, rows, [&](float u, float v) {
        const float fold = std::abs(2 * std::fmod(u * float(pleats), 1.0f) - 1), polar = 0.16f * tau / 2 + 0.84f * tau / 2 * v, a = tau * u;
        const float girth = (0.80f + 0.2f * fold) * std::sin(polar);
        return glm::vec3(girth * std::sin(a), 0.8f * std::cos(polar), girth * std::cos(a));
    }));
}

/// A knot that glows outward: that of the kit has its fronts inside, which only what glows shows.
Mesh neon(int stations, int sides, float thickness) {
    Mesh mesh = knot(stations, sides, thickness);
    std::ranges::reverse(mesh.indices);
    computeNormals(mesh, 180);
    return mesh;
}

Glb makeEnsembleEmitter() {
    Composition c;
    const int wall = c.paint("wall", {0.50f, 0.52f, 0.58f}), floor = c.paint("floor", {0.46f, 0.40f, 0.34f}), left = c.paint("left", {0.16f, 0.33f, 0.42f}),
              right = c.paint("right", {0.55f, 0.33f, 0.17f}), chalk = c.paint("chalk", {0.78f, 0.76f, 0.72f}), plum = c.paint("plum", {0.34f, 0.12f, 0.24f}),
              cord = c.paint("cord", {0.06f, 0.05f, 0.05f}), pearl = c.gloss("pearl", {0.72f, 0.66f, 0.60f}, 0.35f);
    c.glb.addNode(chamber({}, {floor, wall, wall, wall, left, right}));

    c.block("plinth", chalk, {0.62f, 0.34f, 0.62f}, {0.34f, 0, -0.28f}, 24);
    c.put("knot", c.lamp("neon", {5.5f, 1.3f, 1.9f}), neon(84, 8, 0.09f),
          {.translation = {0.34f, 0.80f, -0.28f}, .rotation = glm::angleAxis(1.15f, glm::normalize(glm::vec3(1, 0.15f, 0.1f))), .scale = glm::vec3(0.42f)});

    const int paper = c.glb.addMesh("lamp", pleated(28, 14), c.lamp("paper", {2.6f, 1.9f, 1.1f}));
    struct Hung {
        const char* name;
        glm::vec3 at;
        float radius, turn;
    };
    for (const Hung& lamp : {Hung{"high", {-0.78f, 1.34f, -0.42f}, 0.30f, 0}, Hung{"low", {-0.36f, 0.98f, 0.22f}, 0.17f, 50}}) {
        c.glb.addNode(lamp.name, paper, {.translation = lamp.at, .rotation = turnY(lamp.turn), .scale = glm::vec3(lamp.radius)});
        c.put(std::string(lamp.name) + " cord", cord, bar(lamp.at + glm::vec3(0, 0.8f * lamp.radius, 0), {lamp.at.x, 2.0f, lamp.at.z}, 0.008f, 4));
    }

    c.block("step", plum, {0.95f, 0.15f, 0.46f}, {-0.52f, 0, 0.02f}, -9);
    c.put("jug", chalk, jug(20), {.translation = {-0.74f, 0.15f, 0.0f}, .scale = glm::vec3(0.46f)});
    c.ball("ball", pearl, 0.15f, {-0.30f, 0.15f, 0.06f}, 20);
    c.put("dish", pearl, dish(20), {.translation = {0.78f, 0, 0.42f}, .scale = glm::vec3(0.15f)});
    return std::move(c.glb);
}

}  // namespace

LODESTIR_SCENE(makeEnsembleEmitter, "--levels 4 --ratio 4 --mesh knot --mesh lamp")

}  // namespace lodestir::generate
