// SPDX-License-Identifier: MIT
// Paving: see paving.h.
#include "paving.h"

#include <algorithm>
#include <cmath>

#include "noise.h"
#include "random.h"

namespace lodestir::generate {

Textures paintWetSetts(uint32_t seed, int width) {
    constexpr int rows = 32, columns = 20;
    const Noise ground{seed, {4, 4, 0}}, grain{seed + 1, {160, 160, 0}};
    return paint({.width = width, .height = width, .metres = glm::vec2(settsSize)}, [&](const glm::vec2& p) {
        const glm::vec2 q = p / settsSize;
        const int row = int(q.y * rows);
        // Each row is shifted, and its stones differ in length by a quarter.
        const float along = q.x * columns + unit(hash(seed, uint32_t(row), 7));
        const auto edge = [&](int i) { return float(i) + 0.28f * (unit(hash(seed, uint32_t(row), uint32_t((i % columns + columns) % columns))) - 0.5f); };
        int stone = int(std::floor(along));
        if (along < edge(stone)) --stone;
        if (along >= edge(stone + 1)) ++stone;
        const float metre = settsSize / columns, tall = settsSize / rows;
        const float x = std::min(along - edge(stone), edge(stone + 1) - along) * metre;
        const float y = (0.5f - std::abs(q.y * rows - float(row) - 0.5f)) * tall;
        const float inset = std::min(x, y), corner = std::min(inset, 0.7f * (x + y) - 0.008f);
        const float dome = glm::smoothstep(0.002f, 0.030f, corner);
        const uint32_t id = hash(seed + 5, uint32_t(row), uint32_t((stone % columns + columns) % columns));

        const float wide = ground.fractal(glm::vec3(q * 4.0f, 0.5f), 3, 0.5f), fine = grain.fractal(glm::vec3(q * 160.0f, 0.5f), 2, 0.6f);
        const float top = 0.016f * dome + 0.003f * (unit(hash(id, 1)) - 0.5f) + 0.0008f * fine + 0.010f * wide;
        const float water = 0.0115f;  // level of the puddles
        Surface s;
        const glm::vec3 granite = glm::mix(glm::vec3(0.105f, 0.095f, 0.088f), glm::vec3(0.060f, 0.063f, 0.070f), unit(hash(id, 2)));
        s.color = granite * (0.8f + 0.4f * unit(hash(id, 3))) * (1 + 0.25f * fine);
        s.color = glm::mix(glm::vec3(0.030f, 0.026f, 0.022f), s.color, dome);
        s.roughness = 0.34f + 0.14f * unit(hash(id, 4)) + 0.06f * fine - 0.10f * (1 - dome);
        s.height = top;
        const float under = glm::smoothstep(0.0f, 0.002f, water - top);
        s.roughness = glm::mix(s.roughness, 0.06f, under);
        s.color *= 1 - 0.4f * under;
        s.height = std::max(top, water);
        return s;
    });
}

}  // namespace lodestir::generate
