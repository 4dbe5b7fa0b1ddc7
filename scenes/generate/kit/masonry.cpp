// SPDX-License-Identifier: MIT
// Mineral surfaces: see masonry.h.
#include "masonry.h"

#include <algorithm>
#include <cmath>

#include "noise.h"
#include "random.h"

namespace lodestir::generate {

Textures paintSlate(uint32_t seed, int width) {
    constexpr float tile = 0.6f, grout = 0.0035f;
    const Noise noise{seed};
    return paint({.width = width, .height = width, .metres = glm::vec2(slateSize)}, [&](const glm::vec2& p) {
        const glm::vec2 cell = glm::floor(p / tile), inside = p - cell * tile;
        const uint32_t id = hash(seed, uint32_t(cell.x), uint32_t(cell.y));
        Random random(id);
        const float tone = random.between(0.8f, 1.25f), shift = random.between(0, 50);

        // Cleavage: long soft folds across the tile, each tile from another slab.
        const glm::vec3 q(inside.x * 3 + shift, inside.y * 7 + shift * 0.3f, shift);
        const float fold = noise.fractal(q + 0.6f * noise.at(q * 0.7f), 5, 0.55f);
        const float grain = noise.fractal(glm::vec3(p * 220.0f, 1.5f), 2, 0.5f);
        const float vein = std::pow(noise.ridged(q * 0.6f + glm::vec3(9, 4, 2), 3), 9.0f);

        Surface s;
        s.color = glm::vec3(0.062f, 0.068f, 0.078f) * tone * (1 + 0.45f * fold + 0.14f * grain) + glm::vec3(0.10f, 0.095f, 0.085f) * vein;
        s.roughness = 0.27f + 0.09f * fold + 0.05f * grain;
        s.height = 2.5e-4f * fold + 1e-5f * grain;

        const float edge = std::min({inside.x, inside.y, tile - inside.x, tile - inside.y});
        const float arris = 1 - glm::smoothstep(grout, grout + 0.004f, edge);
        s.height -= 8e-4f * arris * arris;
        if (edge < grout) {
            s.color = glm::vec3(0.30f, 0.28f, 0.25f) * (1 + 0.25f * grain);
            s.roughness = 0.9f;
            s.height = -1.2e-3f + 6e-5f * grain;
        }
        return s;
    });
}

Textures paintPlaster(const glm::vec3& color, uint32_t seed, int width) {
    const Noise noise{seed, {6, 6, 0}};
    const Noise sand{seed + 1, {240, 240, 0}};
    return paint({.width = width, .height = width, .metres = glm::vec2(plasterSize)}, [&](const glm::vec2& p) {
        const glm::vec3 q(p / plasterSize * 6.0f, 0.5f);
        const float stroke = noise.fractal(q, 5, 0.5f);
        const float grain = sand.fractal(glm::vec3(p / plasterSize * 240.0f, 0.5f), 1);
        Surface s;
        s.color = color * (1 + 0.05f * stroke + 0.015f * grain);
        s.roughness = 0.82f + 0.06f * stroke;
        s.height = 1.6e-3f * stroke + 6e-5f * grain;
        return s;
    });
}

Textures paintEarthenware(const glm::vec3& color, uint32_t seed, int width) {
    const Noise noise{seed, {4, 4, 0}};
    const Noise speck{seed + 1, {90, 90, 0}};
    return paint({.width = width, .height = width, .metres = glm::vec2(earthenwareSize)}, [&](const glm::vec2& p) {
        const glm::vec2 q = p / earthenwareSize;
        const float wheel = std::sin(6.2831853f * (q.y * 34 + 0.2f * noise.at({q.x * 4, q.y * 4, 0.5f})));
        const float cloud = noise.fractal(glm::vec3(q * 4.0f, 1.5f), 4);
        const float dot = glm::smoothstep(0.42f, 0.52f, speck.at(glm::vec3(q * 90.0f, 0.5f)));
        Surface s;
        s.color = color * (1 + 0.10f * cloud + 0.02f * wheel) * (1 - 0.55f * dot);
        s.roughness = 0.42f + 0.08f * cloud + 0.2f * dot;
        s.height = 6e-5f * wheel + 2e-4f * cloud;
        return s;
    });
}

}  // namespace lodestir::generate
