// SPDX-License-Identifier: MIT
// Cladding and a planet: see plating.h.
#include "plating.h"

#include <algorithm>
#include <cmath>

#include "noise.h"
#include "random.h"

namespace lodestir::generate {

Textures paintPlates(uint32_t seed, int width) {
    constexpr int rows = 3;
    constexpr float plate = platesSize / rows;
    const Noise wear{seed, {6, 6, 0}}, scratch{seed + 1, {8, 240, 0}};
    return paint({.width = width, .height = width, .metres = glm::vec2(platesSize)}, [&](const glm::vec2& p) {
        // Every second row is shifted by half a plate.
        const int row = int(p.y / plate);
        const float x = p.x / plate + (row % 2 ? 0.5f : 0.0f);
        const int column = int(std::floor(x));
        const uint32_t id = hash(seed, uint32_t(row), uint32_t(column % rows));
        const glm::vec2 inside((x - float(column)) * plate, p.y - float(row) * plate);
        const glm::vec2 edge = glm::min(inside, plate - inside);
        const float seam = 1 - glm::smoothstep(0.004f, 0.010f, std::min(edge.x, edge.y));
        const float bolt = glm::length(edge - 0.07f);
        const float cloud = wear.fractal(glm::vec3(p / platesSize * 6.0f, 0.5f), 5, 0.6f);
        const float line = scratch.fractal(glm::vec3(p.x / platesSize * 8, p.y / platesSize * 240, 1.5f), 2, 0.6f);
        Surface s;
        s.color = glm::vec3(0.085f, 0.092f, 0.105f) * (0.8f + 0.4f * unit(hash(id, 1))) * (1 + 0.25f * cloud);
        s.color *= 1 - 0.7f * seam;
        s.roughness = 0.20f + 0.10f * unit(hash(id, 2)) + 0.13f * cloud + 0.06f * line + 0.4f * seam;
        s.height = -0.003f * seam + 0.0025f * (1 - glm::smoothstep(0.010f, 0.017f, bolt)) + 0.0004f * cloud;
        return s;
    });
}

Textures paintPlanet(uint32_t seed, int width, const glm::vec3& sun) {
    const Noise noise{seed};
    return paintSphere(width, width / 2, [&](const glm::vec3& d) {
        const glm::vec3 warp(noise.fractal(d * 2.5f, 4), noise.fractal(d * 2.5f + 9.0f, 4), noise.fractal(d * 2.5f + 21.0f, 4));
        const float land = noise.fractal(d * 2.2f + 0.35f * warp, 7, 0.55f) + 0.02f, dry = noise.fractal(d * 3.5f + 5.0f, 5);
        const float swirl = noise.fractal(d * glm::vec3(4, 7, 4) + 1.1f * warp + 31.0f, 7, 0.6f);
        Surface s;
        const glm::vec3 sea = glm::mix(glm::vec3(0.010f, 0.045f, 0.12f), glm::vec3(0.03f, 0.16f, 0.24f), glm::smoothstep(-0.10f, 0.02f, land));
        const glm::vec3 soil = glm::mix(glm::vec3(0.07f, 0.13f, 0.05f), glm::vec3(0.42f, 0.28f, 0.15f), glm::smoothstep(-0.2f, 0.25f, dry + 0.5f * land));
        s.color = glm::mix(sea, soil, glm::smoothstep(0.02f, 0.035f, land));
        s.color = glm::mix(s.color, glm::vec3(0.82f), glm::smoothstep(0.86f, 0.93f, std::abs(d.y) + 0.1f * land));
        s.color = glm::mix(s.color, glm::vec3(0.88f), 0.92f * glm::smoothstep(0.06f, 0.42f, swirl));
        // Day, a warm terminator, and the blue of the air that lies over both.
        const float day = glm::dot(d, sun), light = glm::smoothstep(-0.12f, 0.9f, day);
        s.color =
            (s.color + glm::vec3(0.012f, 0.030f, 0.060f)) * glm::mix(glm::vec3(1.1f, 0.75f, 0.5f), glm::vec3(1), glm::smoothstep(0.0f, 0.35f, day)) * light;
        return s;
    });
}

}  // namespace lodestir::generate
