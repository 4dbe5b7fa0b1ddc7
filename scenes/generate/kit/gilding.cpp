// SPDX-License-Identifier: MIT
// Gilded ornament: see gilding.h.
#include "gilding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "metals.h"
#include "noise.h"

namespace lodestir::generate {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// A ridge of half width `half` around distance 0.
float ridge(float distance, float half) {
    const float x = distance / half;
    return std::sqrt(std::max(1 - x * x, 0.0f));
}

/// Height of the ornament at a point; 0 on the ground. `p` from -1 to 1 along the band's repeat (x) and across it (y).
float ornamentAt(glm::vec2 p) {
    float height = 0;
    const auto raise = [&](float h) { height = std::max(height, h); };
    // Beads and fillets along both rims.
    const float rim = 1 - std::abs(p.y);
    raise(0.8f * ridge(rim - 0.05f, 0.05f));
    const float bead = std::abs(std::fmod(std::abs(p.x) * 12, 1.0f) - 0.5f) * 2;
    raise(0.7f * std::sqrt(std::max(1 - bead * bead - std::pow((rim - 0.19f) / 0.07f, 2.0f), 0.0f)));

    p.x *= 1.5f;  // now a unit is as long on both axes
    // The rosette: two rings of petals around a boss.
    const float r = glm::length(p), a = std::atan2(p.y, p.x);
    const auto petals = [&](float reach, float count, float turn) {
        const float lobe = std::abs(std::cos(0.5f * count * (a + turn)));
        if (r < reach * (0.62f + 0.38f * lobe)) raise((0.35f + 0.65f * lobe) * (1 - 0.45f * r / reach));
    };
    petals(0.46f, 8, 0);
    petals(0.28f, 8, pi / 8);
    raise(1.1f * ridge(r, 0.11f));
    // Scrolls: a spiral on either side, leaves along its outer turn.
    for (float side : {-1.0f, 1.0f}) {
        const glm::vec2 q = (p - glm::vec2(side * 0.98f, 0)) * glm::vec2(side, 1);
        const float rs = glm::length(q), turn = std::atan2(q.y, -q.x) / (2 * pi);
        const float arm = rs / 0.21f - turn - 0.5f, distance = std::abs(arm - std::round(arm)) * 0.21f;
        if (rs < 0.5f) raise(ridge(distance, 0.045f + 0.03f * rs) * (1 - 0.4f * rs));
        const float leaf = std::abs(std::cos(9 * std::atan2(q.y, q.x)));
        if (rs > 0.42f && rs < 0.45f + 0.20f * leaf && std::abs(p.y) < 0.72f && std::abs(p.x) < 1.48f) raise(0.75f * leaf);
        raise(ridge(glm::length(q), 0.07f));
    }
    return height;
}

}  // namespace

Textures paintFrieze(const glm::vec3& ground, uint32_t seed, int width) {
    const Noise wear{seed, {9, 6, 0}};
    return paint({.width = width, .height = width * 2 / 3, .metres = friezeSize}, [&](const glm::vec2& p) {
        const glm::vec2 q = 2.0f * p / friezeSize - 1.0f;
        const float height = ornamentAt(q), patina = wear.fractal(glm::vec3(p / friezeSize * glm::vec2(9, 6), 0.5f), 4);
        const float leaf = glm::smoothstep(0.06f, 0.16f, height);
        Surface s;
        s.color = glm::mix(ground * (1 + 0.10f * patina), gold * glm::vec3(0.95f, 0.86f, 0.75f) * (1 + 0.12f * patina), leaf);
        s.color *= 1 - 0.35f * (1 - glm::smoothstep(0.0f, 0.25f, height)) * glm::smoothstep(0.0f, 0.1f, height);  // dust in the corners
        s.metalness = leaf;
        s.roughness = glm::mix(0.5f, 0.27f + 0.10f * patina, leaf);
        s.height = 0.018f * height;
        return s;
    });
}

Textures paintGoldLeaf(uint32_t seed, int width) {
    const Noise noise{seed, {7, 7, 0}};
    return paint({.width = width, .height = width, .metres = glm::vec2(1)}, [&](const glm::vec2& p) {
        const float cloud = noise.fractal(glm::vec3(p * 7.0f, 0.5f), 5, 0.6f);
        const float bole = glm::smoothstep(0.30f, 0.55f, noise.fractal(glm::vec3(p * 7.0f, 4.5f), 5, 0.65f));
        Surface s;
        s.color = glm::mix(gold * glm::vec3(0.95f, 0.86f, 0.75f) * (1 + 0.12f * cloud), glm::vec3(0.30f, 0.10f, 0.05f), 0.6f * bole);
        s.metalness = 1 - 0.6f * bole;
        s.roughness = 0.25f + 0.10f * cloud + 0.3f * bole;
        return s;
    });
}

Textures paintCeiling(uint32_t seed, int width, float metres) {
    constexpr int panels = 16;
    const Noise noise{seed};
    return paint({.width = width, .height = width, .metres = glm::vec2(metres), .repeats = false}, [&](const glm::vec2& p) {
        const glm::vec2 q = 2.0f * p / metres - 1.0f;
        const float r = glm::length(q), a = std::atan2(q.y, q.x), metre = metres / 2;
        const float slice = a / (2 * pi) * panels, across = (slice - std::floor(slice) - 0.5f) * 2 * pi / panels * r * metre;  // from a panel's middle
        const float edge = pi / panels * r * metre - std::abs(across);
        float relief = 0;
        const auto raise = [&](float h) { relief = std::max(relief, h); };
        for (float ring : {0.14f, 0.19f, 0.52f, 0.56f, 0.93f}) raise(ridge((r - ring) * metre, 0.10f));
        if (r > 0.19f && r < 0.93f) raise(ridge(edge, 0.09f));
        // A medallion in each outer panel.
        const glm::vec2 m(across, (r - 0.745f) * metre);
        raise(0.8f * ridge(glm::length(m * glm::vec2(1.0f, 0.62f)) - 0.115f * metre, 0.07f));
        if (r < 0.14f) raise((0.4f + 0.6f * std::abs(std::cos(8 * a))) * glm::smoothstep(0.14f, 0.10f, r) * 0.8f);

        const glm::vec3 w(noise.fractal(glm::vec3(q * 3.0f, 1.5f), 4), noise.fractal(glm::vec3(q * 3.0f, 5.5f), 4), 0);
        const float cloud = noise.fractal(glm::vec3(q * 3.2f, 0.5f) + 0.7f * w, 5, 0.55f);
        const glm::vec3 sky = glm::mix(glm::vec3(0.16f, 0.30f, 0.46f), glm::vec3(0.70f, 0.52f, 0.38f), glm::smoothstep(-0.25f, 0.35f, cloud));
        const glm::vec3 fresco = glm::mix(sky, glm::vec3(0.85f, 0.76f, 0.62f), glm::smoothstep(0.15f, 0.5f, cloud + 0.3f * w.x));
        const bool inMedallion = glm::length(m * glm::vec2(1.0f, 0.62f)) < 0.115f * metre;
        const glm::vec3 paintwork = r < 0.52f || inMedallion ? fresco : r < 0.93f ? glm::vec3(0.46f, 0.085f, 0.060f) : glm::vec3(0.74f, 0.66f, 0.50f);
        const float leaf = glm::smoothstep(0.15f, 0.35f, relief);
        Surface s;
        s.color = glm::mix(paintwork * (1 + 0.12f * cloud), gold * glm::vec3(0.95f, 0.86f, 0.75f), leaf);
        s.metalness = leaf;
        s.roughness = glm::mix(0.75f, 0.30f, leaf);
        s.height = 0.06f * relief;
        return s;
    });
}

}  // namespace lodestir::generate
