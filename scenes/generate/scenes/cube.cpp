// SPDX-License-Identifier: MIT
// A glazed block whose six faces wear one chart: a point of the picture is six points of the block, which only their places tell apart.
#include <cmath>

#include "kit/backdrop.h"
#include "kit/glb.h"
#include "kit/noise.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/wood.h"

namespace lodestir::generate {

namespace {

constexpr int cells = 72;  ///< 12 * 72^2 = 62,208 triangles
constexpr float half = 0.5f, rim = 0.045f;

/// The relief of a face at a point of [-1,1]^2, in units of its depth: a rosette of eight petals in a sunken round, quarter rounds outside.
struct Relief {
    float height = 0;
    float petal = 0, field = 0, line = 0;  ///< shares of what it is made of
};

Relief relief(const glm::vec2& p) {
    const float r = glm::length(p), a = std::atan2(p.y, p.x);
    const auto ring = [](float distance, float width) { return std::exp(-distance * distance / (width * width)); };
    Relief s;
    const float leaf = std::abs(std::cos(4 * a)), reach = 0.16f + 0.44f * std::pow(leaf, 0.8f);
    s.petal = glm::smoothstep(0.0f, 0.05f, reach - r) * glm::smoothstep(0.10f, 0.15f, r);
    const float knob = glm::smoothstep(0.13f, 0.05f, r);
    s.line = std::max(ring(r - 0.70f, 0.022f), knob);
    s.field = 1 - std::max(s.petal, s.line);
    const glm::vec2 corner = glm::vec2(1) - glm::abs(p);
    const float fan =
        glm::smoothstep(0.34f, 0.22f, glm::length(corner - 0.10f)) * (0.7f + 0.3f * std::cos(8 * std::atan2(corner.y, corner.x)));
    const float dish = 1 - glm::smoothstep(0.60f, 0.74f, r);
    s.height = -0.8f * dish + s.petal * (0.75f + 0.35f * std::cos(4 * a) * std::cos(4 * a) - 0.8f * r) + 1.0f * ring(r - 0.70f, 0.065f) +
               0.9f * std::sqrt(knob) + 0.45f * fan;
    // Nothing is left of it at the edges of the face, so that six faces close.
    const glm::vec2 away = glm::smoothstep(glm::vec2(0.02f), glm::vec2(0.16f), glm::vec2(1) - glm::abs(p));
    s.height *= away.x * away.y;
    return s;
}

/// One face, seen from +z. Its rounded border is shared bit for bit with its neighbours: it only depends on the point of the cube.
Mesh face(const glm::mat3& turn) {
    Mesh mesh = grid(cells, cells, [&](float u, float v) {
        // Whole numbers: the rounding of neighbouring faces must not differ.
        const glm::ivec2 step(int(std::lround(u * cells)), int(std::lround(v * cells)));
        const glm::vec2 p = glm::vec2(2 * step.x - cells, cells - 2 * step.y) / float(cells);
        const glm::vec3 cube = turn * glm::vec3(p, 1) * half;
        const glm::vec3 inner = glm::clamp(cube, -(half - rim), half - rim);
        const glm::vec3 rounded = inner + glm::normalize(cube - inner) * rim;
        return rounded + turn * glm::vec3(0, 0, 0.055f * relief(p).height);
    });
    return mesh;
}

Glb makeCube() {
    Glb glb;
    const Noise noise{31};
    const Textures glaze = paint({.width = 1024, .height = 1024, .repeats = false, .smooth = true}, [&](const glm::vec2& m) {
        const Relief r = relief(2.0f * glm::vec2(m.x, 1 - m.y) - 1.0f);
        const float pool = glm::clamp(-r.height, 0.0f, 1.0f), mottle = noise.fractal(glm::vec3(m * 9.0f, 0.5f), 4);
        const glm::vec3 sea = glm::mix(glm::vec3(0.02f, 0.17f, 0.22f), glm::vec3(0.006f, 0.055f, 0.11f), pool) * (1 + 0.25f * mottle);
        Surface s;
        s.color = glm::mix(sea, glm::vec3(0.74f, 0.66f, 0.50f) * (1 + 0.06f * mottle), r.petal);
        s.color = glm::mix(s.color, glm::vec3(0.85f, 0.56f, 0.22f), r.line);
        s.metalness = r.line;
        s.roughness = glm::mix(0.13f + 0.04f * mottle, 0.26f, r.line);
        return s;
    });
    Mesh cube;
    const glm::mat3 turns[] = {
        glm::mat3(1),
        glm::mat3({-1, 0, 0}, {0, 1, 0}, {0, 0, -1}),
        glm::mat3({0, 0, -1}, {0, 1, 0}, {1, 0, 0}),
        glm::mat3({0, 0, 1}, {0, 1, 0}, {-1, 0, 0}),
        glm::mat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0}),
        glm::mat3({1, 0, 0}, {0, 0, 1}, {0, -1, 0}),
    };
    for (const glm::mat3& turn : turns) append(cube, face(turn));
    computeNormals(cube, 180);
    Model block{"cube", {}};
    block.add(glb.addMaterial(glb.dressed({.name = "glaze"}, glaze)), cube);
    glb.addNode(block, {.translation = {0, 0.555f, 0}, .rotation = turnY(-14)});

    addTable(glb, {.size = {3.6f, 0.08f, 2.4f}, .edge = 0.02f, .centre = {0, -0.04f, -0.1f}, .grain = 0.6f, .material = "oak", .wood = oak(), .seed = 9});
    addWall(glb, {.name = "plaster", .color = {0.52f, 0.48f, 0.43f}, .roughness = 0.95f}, {-6, 4, -1.6f}, {12, 0, 0}, {0, -6, 0});
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeCube, "--levels 4 --ratio 4 --mesh cube")

}  // namespace lodestir::generate
