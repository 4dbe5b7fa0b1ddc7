// SPDX-License-Identifier: MIT
// Paper lanterns: see lantern.h.
#include "lantern.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "noise.h"
#include "random.h"
#include "shapes.h"

namespace lodestir::generate {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr int rings = 22;
constexpr float mouth = 0.42f;  ///< radius of the openings

/// Distance to the nearest ring in pleats: 0 on it, 1/2 between two.
float toRing(float v) { return std::abs(v * rings - std::round(v * rings)); }

}  // namespace

Mesh lanternPaper() {
    const Noise noise{51, {}};
    return grid(240, 10 * rings, [&](float u, float v) {
        const float a = 2 * pi * u, bulge = std::sin(pi * v);
        const float girth = mouth + (1 - mouth) * std::pow(bulge, 0.62f);
        // Paper sinks in between the rings, more where it is wide; it was wet when it was glued and dried with creases.
        const glm::vec3 around(std::sin(a), 0, std::cos(a));
        const float sag = (0.012f + 0.030f * bulge) * (1 - std::pow(1 - 2 * toRing(v), 2.0f));
        const float crease = 0.006f * noise.fractal(around * 7.0f + glm::vec3(0, v * 30, 0), 4) * std::min(4 * toRing(v), 1.0f);
        return around * (girth - sag + crease) + glm::vec3(0, 1 - 2 * v, 0);
    });
}

Textures paintLanternPaper(const glm::vec3& tint, const glm::vec3& ink, uint32_t seed, int width) {
    const Noise fibre{seed, {}};
    return paint({.width = 2 * width, .height = width, .metres = {2 * pi, 2}, .repeats = false, .smooth = true}, [&](const glm::vec2& p) {
        const float a = p.x, v = p.y / 2, up = 1 - p.y;
        const glm::vec3 around(std::sin(a), up, std::cos(a));
        // The flame stands in the lower half; its light falls off along the paper, and the paper is not of one thickness.
        float glow = 0.34f + 0.66f * std::exp(-1.5f * (up + 0.15f) * (up + 0.15f));
        glow *= 1 + 0.13f * fibre.fractal(around * glm::vec3(9, 26, 9), 4, 0.6f) + 0.05f * fibre.fractal(around * 60.0f, 2);
        glow *= 1 - 0.55f * glm::smoothstep(0.07f, 0.02f, toRing(v)) - 0.18f * glm::smoothstep(0.25f, 0.5f, toRing(v));
        // A crest on each side: five petals in a ring; brushed, so that its edge is ragged.
        const float turn = std::remainder(a - pi / 2, pi);
        const glm::vec2 q = glm::vec2(turn * 0.95f, up) + 0.012f * glm::vec2(fibre.at(around * 24.0f), fibre.at(around * 24.0f + 9.0f));
        const float r = glm::length(q), angle = std::atan2(q.x, q.y);
        const float petal = 0.15f + 0.25f * std::pow(std::abs(std::cos(2.5f * angle)), 0.7f);
        const float vein =
            glm::smoothstep(0.05f, 0.03f, r * std::abs(std::sin(0.2f * 2 * pi * std::round(angle / (0.4f * pi)) - angle))) * glm::smoothstep(0.3f, 0.2f, r);
        float inked = glm::smoothstep(0.012f, -0.012f, r - petal) * glm::smoothstep(0.07f, 0.09f, r) * (1 - vein);
        inked = std::max(inked, glm::smoothstep(0.045f, 0.025f, std::abs(r - 0.52f)));
        inked = std::max(inked, glm::smoothstep(0.74f, 0.755f, std::abs(up)) - glm::smoothstep(0.80f, 0.815f, std::abs(up)));
        inked = std::max(inked, glm::smoothstep(0.84f, 0.855f, std::abs(up)));
        Surface s;
        s.color = glow * glm::mix(tint, tint * ink, 0.94f * inked);
        return s;
    });
}

LanternFittings lanternFittings(float drop) {
    LanternFittings fittings;
    for (float side : {-1.0f, 1.0f}) {
        std::vector<glm::vec2> hoop{{mouth - 0.05f, 0.11f}, {mouth + 0.01f, 0.12f},  {mouth + 0.03f, 0.10f}, {mouth + 0.035f, 0.03f},
                                    {mouth + 0.05f, 0.0f},  {mouth + 0.05f, -0.06f}, {mouth - 0.05f, -0.06f}};
        if (side > 0) hoop.insert(hoop.begin(), {0, 0.10f});  // a lid
        for (glm::vec2& p : hoop) p.y = side * (p.y + 1);
        if (side < 0) std::ranges::reverse(hoop);
        append(fittings.lacquer, turned(hoop, 56));
    }
    for (float side : {-1.0f, 1.0f}) append(fittings.lacquer, bar({side * mouth, 1.1f, 0}, {0, 1.55f, 0}, 0.014f, 6));
    append(fittings.lacquer, bar({0, 1.54f, 0}, {0, drop, 0}, 0.018f, 8));
    const glm::vec2 opening[] = {{mouth, -0.99f}, {0, -0.99f}};
    append(fittings.flame, turned(opening, 20));
    const glm::vec2 knot[] = {{0, -1.30f}, {0.05f, -1.33f}, {0.075f, -1.38f}, {0.05f, -1.43f}, {0.035f, -1.45f}};
    append(fittings.silk, turned(knot, 20));
    for (float x : {-1.0f, 1.0f}) append(fittings.silk, bar({x * (mouth - 0.02f), -1.05f, 0}, {0, -1.32f, 0}, 0.012f, 6));
    Random random(8);
    for (int i = 0; i < 70; ++i) {
        const float a = 2 * pi * float(i) / 70, out = 0.10f * std::sqrt(random.next());
        const glm::vec3 d(std::cos(a), 0, std::sin(a));
        append(fittings.silk, bar(glm::vec3(0, -1.44f, 0) + 0.03f * d, glm::vec3(0, random.between(-2.0f, -1.9f), 0) + out * d, 0.008f, 5));
    }
    return fittings;
}

}  // namespace lodestir::generate
