// SPDX-License-Identifier: MIT
// A drum on a block whose charts meet in seams: what lies side by side on the surface lies far apart in the picture, with magenta between, and on the
// drum's upper half coordinates run on from 1 into the picture's next copy. The mean of two coordinates across a seam is a place whose colour is nowhere
// on the surface.
#include <array>
#include <cmath>
#include <numbers>

#include "kit/backdrop.h"
#include "kit/scene.h"
#include "kit/shapes.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;
constexpr int texels = 1024, tiles = 8;  ///< of the picture; charts are squares of an eighth
constexpr float margin = 0.06f;          ///< of a chart, painted but never sampled between texels

/// A chart of the picture, from its column and row.
glm::vec2 chartUv(const glm::ivec2& chart, const glm::vec2& within) {
    return (glm::vec2(chart) + margin + (1 - 2 * margin) * glm::clamp(within, 0.0f, 1.0f)) / float(tiles);
}

/// Charts lie two tiles apart both ways; whatever else there is, is magenta. The bottom two rows are the band that repeats.
constexpr std::array<glm::ivec2, 9> charts = {{{0, 0}, {2, 0}, {4, 0}, {6, 0}, {0, 2}, {2, 2}, {4, 2}, {6, 2}, {0, 4}}};
constexpr float bandTop = 0.76f, bandFoot = 0.99f;

Textures paintPicture() {
    return paint({.width = texels, .height = texels, .metres = {1, 1}}, [](const glm::vec2& p) {
        Surface s;
        s.roughness = 1;
        s.color = {0.80f, 0.02f, 0.55f};  // nowhere on the surface
        const glm::ivec2 tile = glm::ivec2(p * float(tiles));
        const glm::vec3 teal(0.03f, 0.32f, 0.30f), cream(0.78f, 0.68f, 0.48f);
        for (const glm::ivec2& chart : charts) {
            if (tile != chart) continue;
            const glm::vec2 w = (p * float(tiles) - glm::vec2(chart) - margin) / (1 - 2 * margin);
            s.color = glm::mix(teal, cream, 0.5f + 0.5f * std::cos(3 * tau * w.y));  // stripes that run on over seams
        }
        // The band: its colour at 0 and 1 is the same, and magenta in the middle of the picture would be its mean. Only [0.75, 1.25] is worn.
        if (p.y > 0.75f && std::abs(p.x - 0.5f) > 0.24f) s.color = glm::mix(teal, cream, 0.5f + 0.5f * std::cos(4 * tau * p.x));
        return s;
    });
}

Glb makeSeam() {
    Glb glb;
    Material worn = glb.dressed({.name = "seam"}, paintPicture());
    worn.ior = 1;  // no gloss: all that is seen is the picture
    Mesh mesh;
    const auto add = [&](int columns, int rows, const auto& at, const auto& uv) {
        Mesh part = grid(columns, rows, at);
        for (Vertex& v : part.vertices) v.uv = uv(v.uv);
        append(mesh, part);
    };
    // The block: a chart a face.
    constexpr float block = 0.55f;
    const glm::vec3 rights[] = {{1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {0, 0, 1}}, outs[] = {{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, {-1, 0, 0}};
    for (size_t f = 0; f < 4; ++f)
        add(
            8, 8, [&](float u, float v) { return block * (outs[f] + (2 * u - 1) * rights[f]) + glm::vec3(0, -0.85f + 0.7f * (1 - v), 0); },
            [&](const glm::vec2& w) { return chartUv(charts[f], w); });
    add(
        8, 8, [](float u, float v) { return glm::vec3(block * (2 * u - 1), -0.15f, block * (2 * v - 1)); },
        [](const glm::vec2& w) { return chartUv(charts[4], w); });
    add(
        8, 8, [](float u, float v) { return glm::vec3(block * (2 * u - 1), -0.85f, block * (1 - 2 * v)); },
        [](const glm::vec2& w) { return chartUv(charts[5], w); });
    // The drum: below two charts of half its girth each, above the band twice around, whose coordinates cross 1 without a cut.
    constexpr float radius = 0.42f;
    const auto drum = [](float turn, float y) { return glm::vec3(radius * std::sin(tau * turn), y, radius * std::cos(tau * turn)); };
    for (int side = 0; side < 2; ++side)
        add(
            48, 8, [&](float u, float v) { return drum(0.5f * (u + float(side)) + 0.05f, 0.35f - 0.5f * v); },
            [&](const glm::vec2& w) { return chartUv(charts[size_t(6 + side)], w); });
    for (int side = 0; side < 2; ++side)
        add(
            48, 8, [&](float u, float v) { return drum(0.5f * (u + float(side)) + 0.05f, 0.85f - 0.5f * v); },
            [&](const glm::vec2& w) { return glm::vec2(0.75f + 0.5f * w.x, glm::mix(bandTop, bandFoot, w.y)); });
    const glm::vec3 top(0, 0.85f, 0);
    add(
        96, 8, [&](float u, float v) { return v == 0 ? top : glm::mix(top, drum(u == 1 ? 0 : u, top.y), v); },
        [](const glm::vec2& w) {
            return chartUv(charts[8], {0.5f, w.y});
        });
    computeNormals(mesh, 40);
    Model model{"seam", {}};
    model.add(glb.addMaterial(worn), mesh);
    glb.addNode(model);
    addLamp(glb, {0, 0, 0}, 1, {11, 10.2f, 9});
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeSeam)

}  // namespace lodestir::generate
