// SPDX-License-Identifier: MIT
// Wood: see wood.h.
#include "wood.h"

#include <algorithm>
#include <cmath>

#include "noise.h"
#include "random.h"

namespace lodestir::generate {

Wood oak() { return {.early = {0.56f, 0.38f, 0.21f}, .late = {0.38f, 0.23f, 0.11f}, .roughness = 0.42f, .pores = 1}; }
Wood walnut() { return {.early = {0.16f, 0.085f, 0.045f}, .late = {0.075f, 0.037f, 0.02f}, .roughness = 0.38f, .pores = 0.8f}; }
Wood birch() { return {.early = {0.68f, 0.52f, 0.33f}, .late = {0.56f, 0.40f, 0.23f}, .roughness = 0.5f, .pores = 0.25f}; }

Surface boardAt(const Wood& wood, const glm::vec2& p, uint32_t board) {
    Random random(board);
    const float shift = random.between(0, 100), pith = random.between(-0.10f, 0.10f), depth = random.between(0.015f, 0.09f);
    const float tone = random.between(0.80f, 1.16f), warmth = random.between(-0.05f, 0.05f);
    const Noise noise{board};

    // The log's axis wanders below the board; rings are distances from it, a few millimetres apart.
    const float x = p.x + shift;
    const float across = p.y + pith + 0.012f * noise.at({x * 1.3f, 0.5f, 3.1f});
    const float below = depth + 0.03f * noise.at({x * 0.9f, 7.5f, 1.7f});
    const float radius = std::sqrt(across * across + below * below) + 0.0012f * noise.at({x * 6, p.y * 60, 0.3f});
    const float ring = radius * 170 + 0.3f * noise.at({radius * 40, 0.2f, shift});
    const float phase = ring - std::floor(ring);
    // Growth darkens slowly through the summer and stops at once; the fall is softened over a tenth of a ring against aliasing.
    const float late = std::pow(phase, 2.5f) * (1 - glm::smoothstep(0.88f, 1.0f, phase));

    const float fibre = noise.fractal({x * 14, p.y * 650, 5.5f}, 2, 0.6f);
    const float vessel = noise.at({x * 32, p.y * 900, 9.5f});
    const float pore = glm::smoothstep(0.28f, 0.5f, vessel) * (0.35f + 0.65f * (1 - late)) * wood.pores;

    Surface s;
    s.color = glm::mix(wood.early, wood.late, glm::clamp(0.15f + 0.75f * late + 0.16f * fibre, 0.0f, 1.0f));
    s.color *= tone * glm::vec3(1 + warmth, 1, 1 - warmth) * (1 - 0.42f * pore);
    s.roughness = wood.roughness + 0.10f * pore + 0.06f * fibre;
    s.height = 2e-5f * fibre - 9e-5f * pore;
    return s;
}

namespace {

/// Darkens and lowers a surface near the joint at `distance` metres.
void joint(Surface& s, float distance, float width, float depth) {
    const float open = 1 - glm::smoothstep(0.0f, width, distance);
    s.color *= 1 - 0.55f * open * open;
    s.height -= depth * open;
    s.roughness += 0.2f * open;
}

}  // namespace

Textures paintPanel(const Wood& wood, uint32_t seed, int width) {
    constexpr float board = 0.15f;
    return paint({.width = width, .height = width / 2, .metres = panelSize}, [&](const glm::vec2& p) {
        const float row = std::floor(p.y / board), y = p.y - (row + 0.5f) * board;
        // Each row butts two boards, so that the picture wraps at a joint that a joiner could have made.
        const float start = unit(hash(seed, uint32_t(row))) * panelSize.x;
        const float along = std::fmod(p.x - start + panelSize.x, panelSize.x);
        Surface s = boardAt(wood, {along, y}, hash(seed, uint32_t(row), 17));
        s.color *= 1 - 0.18f * (1 - glm::smoothstep(0.0f, 0.0012f, board / 2 - std::abs(y)));
        return s;
    });
}

Textures paintHerringbone(const Wood& wood, uint32_t seed, int width) {
    constexpr float block = 0.09f;
    constexpr int length = 5, period = 2 * length, cells = int(herringboneSize / block + 0.5f);
    return paint({.width = width, .height = width, .metres = glm::vec2(herringboneSize)}, [&](const glm::vec2& p) {
        // Cells of one block width: along a diagonal of `period` cells, the first half lies across and the second half stands up.
        const glm::ivec2 cell(glm::floor(p / block));
        const int step = ((cell.x - cell.y) % period + period) % period;
        const bool lying = step < length;
        const glm::ivec2 first = lying ? glm::ivec2(cell.x - step, cell.y) : glm::ivec2(cell.x, cell.y - (period - 1 - step));
        const glm::vec2 inside = p - glm::vec2(first) * block;
        const glm::vec2 q = lying ? inside : glm::vec2(inside.y, inside.x);  // x along the block

        const glm::ivec2 home = (first % cells + cells) % cells;
        Surface s = boardAt(wood, {q.x, q.y - block / 2}, hash(seed, uint32_t(home.x), uint32_t(home.y)));
        const float edge = std::min({q.x, length * block - q.x, q.y, block - q.y});
        joint(s, edge, 0.0018f, 4e-4f);
        return s;
    });
}

}  // namespace lodestir::generate
