// SPDX-License-Identifier: MIT
// Washes: see watercolour.h.
#include "watercolour.h"

#include <algorithm>
#include <cmath>

#include "noise.h"
#include "random.h"

namespace lodestir::generate {

namespace {

/// Tone of a wash: granulation where pigment settles in the paper, backruns where wet met drier paint.
float washAt(const Noise& patch, const Noise& paper, const glm::vec2& q) {
    const glm::vec2 warp(patch.fractal(glm::vec3(q, 4.5f), 4), patch.fractal(glm::vec3(q, 8.5f), 4));
    const Cell cell = patch.cell(glm::vec3(q + 0.45f * warp, 0.5f));
    const float rim = 1 - glm::smoothstep(0.0f, 0.09f, cell.second - cell.nearest);
    const float pool = patch.fractal(glm::vec3(q + 0.6f * warp, 2.5f), 4, 0.55f), grain = paper.fractal(glm::vec3(q * 32.0f, 0.5f), 3, 0.6f);
    return 0.90f + 0.12f * (unit(hash(cell.id, 3)) - 0.5f) + 0.15f * pool - 0.20f * rim * rim + 0.05f * grain;
}

}  // namespace

Material wash(const Material& picture, const std::string& name, const glm::vec3& color) {
    Material paint = picture;
    paint.name = name, paint.color = color, paint.ior = 1;
    return paint;
}

Textures paintWash(uint32_t seed, int width) {
    const Noise patch{seed, {5, 5, 0}}, paper{seed + 1, {160, 160, 0}};
    return paint({.width = width, .height = width, .metres = glm::vec2(washSize), .smooth = true}, [&](const glm::vec2& p) {
        const glm::vec2 q = p / washSize * 5.0f;
        const float tone = washAt(patch, paper, q), hue = patch.fractal(glm::vec3(q, 12.5f), 3);
        Surface s;
        s.color = glm::clamp(tone * glm::vec3(1 + 0.06f * hue, 1, 1 - 0.08f * hue), 0.0f, 1.0f);
        s.roughness = 1;
        return s;
    });
}

Textures paintRoof(uint32_t seed, int width) {
    constexpr int courses = 14, tiles = 16;
    const Noise patch{seed, {5, 5, 0}}, paper{seed + 1, {160, 160, 0}};
    return paint({.width = width, .height = width, .metres = glm::vec2(roofSize), .smooth = true}, [&](const glm::vec2& p) {
        const glm::vec2 q = p / roofSize;
        const float wobble = 0.12f * patch.fractal(glm::vec3(q * 5.0f, 6.5f), 4);
        const float y = q.y * courses + wobble;
        const int course = int(std::floor(y));
        const float x = q.x * tiles + (course % 2 ? 0.5f : 0.0f) + wobble;
        const int tile = int(std::floor(x));
        const float fx = x - float(tile), fy = y - float(course);
        const uint32_t id = hash(seed, uint32_t((course % courses + courses) % courses), uint32_t((tile % tiles + tiles) % tiles));
        // The stroke is drawn down the tile: light at its head, pigment gathers at its foot and sides.
        const float foot = glm::smoothstep(0.55f, 0.95f, fy), side = 1 - glm::smoothstep(0.0f, 0.14f, std::min(fx, 1 - fx));
        const float tone = washAt(patch, paper, q * 5.0f) * (0.80f + 0.34f * unit(hash(id, 1))) - 0.20f * foot - 0.16f * side;
        Surface s;
        s.color = glm::clamp(tone * glm::vec3(1, 1 + 0.12f * (unit(hash(id, 2)) - 0.5f), 1 + 0.2f * (unit(hash(id, 3)) - 0.5f)), 0.02f, 1.0f);
        s.roughness = 1;
        return s;
    });
}

}  // namespace lodestir::generate
