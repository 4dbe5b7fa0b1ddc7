// SPDX-License-Identifier: MIT
// Dressed stone: see marble.h.
#include "marble.h"

#include <algorithm>
#include <cmath>

#include "noise.h"
#include "random.h"

namespace lodestir::generate {

namespace {

/// A point of a slab, in metres; what repeats is up to the noise.
Surface marbleAt(const Marble& marble, const Noise& noise, const glm::vec3& p) {
    const glm::vec3 warp(noise.fractal(p + glm::vec3(0, 0, 3.5f), 4), noise.fractal(p + glm::vec3(0, 0, 7.5f), 4), 0);
    const float cloud = noise.fractal(p + 0.5f * warp, 4, 0.55f);
    const float broad = std::pow(noise.ridged(p + 0.9f * warp, 3, 0.5f), 8.0f),
                thin = std::pow(noise.ridged(p + 0.7f * warp + glm::vec3(0, 0, 5), 4, 0.6f), 14.0f);
    Surface s;
    s.color = marble.ground * (1 + 0.16f * cloud);
    s.color = glm::mix(s.color, marble.vein, glm::clamp(0.75f * broad + 0.6f * thin, 0.0f, 0.9f));
    s.roughness = marble.roughness + 0.05f * cloud;
    return s;
}

}  // namespace

Marble carrara() { return {{0.74f, 0.71f, 0.66f}, {0.27f, 0.26f, 0.26f}}; }
Marble verde() { return {{0.035f, 0.085f, 0.062f}, {0.35f, 0.42f, 0.34f}}; }

Textures paintMarble(const Marble& marble, uint32_t seed, int width) {
    const Noise noise{seed, {4, 4, 0}};
    return paint({.width = width, .height = width, .metres = glm::vec2(slabSize)},
                 [&](const glm::vec2& p) { return marbleAt(marble, noise, glm::vec3(p / slabSize * 4.0f, 0.5f)); });
}

Textures paintMarbleFloor(const Marble& light, const Marble& dark, uint32_t seed, int width) {
    constexpr float tile = marbleFloorSize / 4;
    const Noise noise{seed};
    return paint({.width = width, .height = width, .metres = glm::vec2(marbleFloorSize)}, [&](const glm::vec2& p) {
        const glm::vec2 cell = glm::floor(p / tile), inside = p - cell * tile;
        const uint32_t id = hash(seed, uint32_t(cell.x), uint32_t(cell.y));
        const bool isDark = (int(cell.x) + int(cell.y)) % 2 != 0;
        Surface s = marbleAt(isDark ? dark : light, noise, glm::vec3(inside * 1.6f, 50 * unit(id)));
        s.color *= 0.9f + 0.2f * unit(hash(id, 1));
        const float edge = std::min({inside.x, inside.y, tile - inside.x, tile - inside.y});
        if (edge < 0.003f) {
            s.color *= 0.4f;
            s.roughness = 0.6f;
        }
        // Tiles are laid by hand: each tips a little, and its rim is worn.
        const glm::vec2 tip = glm::vec2(unit(hash(id, 2)), unit(hash(id, 3))) - 0.5f;
        s.height = 0.0025f * glm::dot(tip, inside / tile - 0.5f) - 0.0012f * (1 - glm::smoothstep(0.0f, 0.012f, edge)) +
                   0.0006f * noise.fractal(glm::vec3(p * 2.5f, 9.5f), 2);
        return s;
    });
}

Textures paintAshlar(const glm::vec3& color, uint32_t seed, int width) {
    constexpr int courses = 8, blocks = 4;
    constexpr float tall = ashlarSize / courses, wide = ashlarSize / blocks;
    const Noise broad{seed, {8, 8, 0}}, grain{seed + 1, {120, 120, 0}};
    return paint({.width = width, .height = width, .metres = glm::vec2(ashlarSize)}, [&](const glm::vec2& p) {
        const int course = int(p.y / tall);
        const float x = p.x / wide + (course % 2 ? 0.5f : 0.0f) + 0.25f * (unit(hash(seed, uint32_t(course))) - 0.5f);
        const int block = int(std::floor(x));
        const uint32_t id = hash(seed, uint32_t(course), uint32_t((block % blocks + blocks) % blocks));
        const float fx = (x - float(block)) * wide, fy = p.y - float(course) * tall;
        const float edge = std::min({fx, wide - fx, fy, tall - fy});
        const float cloud = broad.fractal(glm::vec3(p / ashlarSize * 8.0f, 0.5f), 5, 0.55f),
                    fine = grain.fractal(glm::vec3(p / ashlarSize * 120.0f, 0.5f), 2, 0.6f);
        Surface s;
        s.color = color * (0.84f + 0.3f * unit(hash(id, 1))) * glm::vec3(1 + 0.06f * (unit(hash(id, 2)) - 0.5f), 1, 1 - 0.10f * (unit(hash(id, 3)) - 0.5f));
        s.color *= 1 + 0.22f * cloud + 0.10f * fine;
        const float joint = 1 - glm::smoothstep(0.003f, 0.010f, edge);
        s.color *= 1 - 0.45f * joint;
        s.roughness = 0.88f;
        s.height = 0.002f * cloud + 0.0004f * fine - 0.006f * joint + 0.002f * (unit(hash(id, 4)) - 0.5f);
        return s;
    });
}

}  // namespace lodestir::generate
