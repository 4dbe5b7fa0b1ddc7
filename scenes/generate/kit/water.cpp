// SPDX-License-Identifier: MIT
// Water: see water.h.
#include "water.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "random.h"
#include "shapes.h"

namespace lodestir::generate {

Mesh waterSheet(const glm::vec2& low, const glm::vec2& high, float cell, const Waves& waves) {
    // A sum of sines whose headings spread by a radian or so and whose heights fall with their lengths: a calm spectrum.
    struct Sine {
        glm::vec2 k;
        float height, phase;
    };
    std::vector<Sine> sines;
    Random random(waves.seed);
    constexpr int count = 22;
    for (int i = 0; i < count; ++i) {
        const float length = waves.length * std::pow(0.30f, float(i) / count), heading = waves.heading + 0.75f * random.bell();
        const float k = 2 * std::numbers::pi_v<float> / length;
        sines.push_back({k * glm::vec2(std::cos(heading), std::sin(heading)), waves.height * 0.45f * length / waves.length, random.between(0, 6.2831853f)});
    }
    const glm::vec2 size = high - low;
    Mesh sheet = grid(std::max(int(size.x / cell), 1), std::max(int(size.y / cell), 1), [&](float u, float v) {
        const glm::vec2 p = low + size * glm::vec2(u, v);
        float y = 0;
        for (const Sine& s : sines) y += s.height * std::sin(glm::dot(s.k, p) + s.phase);
        return glm::vec3(p.x, y, p.y);
    });
    scaleUv(sheet, size);
    return sheet;
}

}  // namespace lodestir::generate
