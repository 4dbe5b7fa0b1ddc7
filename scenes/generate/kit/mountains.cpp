// SPDX-License-Identifier: MIT
// Mountains: see mountains.h.
#include "mountains.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "figure.h"
#include "landscape.h"
#include "random.h"
#include "shapes.h"

namespace lodestir::generate {

namespace {

constexpr int side = 512;  ///< points a side
constexpr float cell = Mountains::size / (side - 1);

/// A valley that winds along z, low at the origin and open towards +z, between ridges.
float untouched(const Noise& noise, const glm::vec2& xz) {
    const glm::vec3 p(xz.x, 0.5f, xz.y);
    const glm::vec3 q = p + 180.0f * glm::vec3(noise.fractal(p * 0.0011f, 3), 0, noise.fractal(p * 0.0011f + 31.0f, 3));
    const float middle = 170 * std::sin(xz.y * 0.0021f + 0.6f), across = std::abs(xz.x - middle);
    const float wall = glm::smoothstep(110.0f, 1150.0f, across), end = glm::smoothstep(-350.0f, -1700.0f, xz.y);
    const float rise = std::max(wall, 0.92f * end);
    const float ridges = noise.ridged(q * 0.00092f + 3.0f, 6, 0.40f), swell = noise.fractal(p * 0.0022f + 7.0f, 5);
    return 55 + 40 * swell * (0.3f + rise) + rise * (150 + 860 * ridges * (0.55f + 0.45f * rise)) + 12 * noise.fractal(p * 0.012f, 4);
}

}  // namespace

Mountains::Mountains(uint32_t seed) : noise{seed, {}}, heights(size_t(side) * side) {
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) heights[size_t(y * side + x)] = untouched(noise, (glm::vec2(x, y) / float(side - 1) - 0.5f) * size);
    erode(110'000);
    // The shore is steep, or coarse levels would rise out of the lake.
    for (float& h : heights) h -= 22 * glm::smoothstep(lake + 5, lake - 4, h);
}

/// Drops run downhill, take soil while they are fast and leave it where they slow down (after H. T. Beyer, "Implementation of a method for hydraulic
/// erosion", 2015). Heights are in cells here.
void Mountains::erode(int drops) {
    constexpr float inertia = 0.06f, capacity = 5, deposit = 0.25f, take = 0.35f, evaporation = 0.014f, gravity = 5;
    constexpr int life = 70;
    Random random(noise.seed + 99);
    for (float& h : heights) h /= cell;
    const auto cornersOf = [&](const glm::vec2& p) {
        const glm::ivec2 c(p);
        const size_t first = size_t(c.y * side + c.x);
        const glm::vec2 f = p - glm::vec2(c);
        struct Corners {
            std::array<size_t, 4> at;
            std::array<float, 4> weight;
        };
        return Corners{{first, first + 1, first + side, first + side + 1}, {(1 - f.x) * (1 - f.y), f.x * (1 - f.y), (1 - f.x) * f.y, f.x * f.y}};
    };
    for (int i = 0; i < drops; ++i) {
        glm::vec2 p(random.between(1, side - 2), random.between(1, side - 2)), way(0);
        float speed = 1, water = 1, load = 0;
        for (int step = 0; step < life; ++step) {
            const auto corners = cornersOf(p);
            const glm::vec2 f = glm::fract(p);
            const auto h = [&](int k) { return heights[corners.at[size_t(k)]]; };
            const glm::vec2 slope(glm::mix(h(1) - h(0), h(3) - h(2), f.y), glm::mix(h(2) - h(0), h(3) - h(1), f.x));
            const auto heightAt = [&](const auto& c) {
                float sum = 0;
                for (size_t k = 0; k < 4; ++k) sum += c.weight[k] * heights[c.at[k]];
                return sum;
            };
            const float before = heightAt(corners);
            way = way * inertia - slope * (1 - inertia);
            if (glm::dot(way, way) < 1e-12f) break;
            way = glm::normalize(way);
            p += way;
            if (p.x < 1 || p.y < 1 || p.x >= side - 2 || p.y >= side - 2) break;
            const float fall = heightAt(cornersOf(p)) - before, carries = std::max(-fall, 0.01f) * speed * water * capacity;
            float change;  // of the ground that the drop came from
            if (fall > 0 || load > carries)
                change = fall > 0 ? std::min(fall, load) : (load - carries) * deposit;
            else
                change = -std::min((carries - load) * take, -fall);
            load -= change;
            for (size_t k = 0; k < 4; ++k) heights[corners.at[k]] += change * corners.weight[k];
            speed = std::sqrt(std::max(speed * speed - fall * gravity, 0.0f));
            water *= 1 - evaporation;
        }
    }
    for (float& h : heights) h *= cell;
}

float Mountains::height(const glm::vec2& xz) const {
    const glm::vec2 p = glm::clamp((xz / size + 0.5f) * float(side - 1), 0.0f, float(side) - 1.001f);
    const glm::ivec2 c(p);
    const glm::vec2 f = p - glm::vec2(c);
    const float* h = &heights[size_t(c.y * side + c.x)];
    return glm::mix(glm::mix(h[0], h[1], f.x), glm::mix(h[side], h[side + 1], f.x), f.y);
}

glm::vec3 Mountains::normal(const glm::vec2& xz) const {
    const glm::vec2 x(cell, 0), y(0, cell);
    return glm::normalize(glm::vec3(height(xz - x) - height(xz + x), 2 * cell, height(xz - y) - height(xz + y)));
}

float Mountains::forest(const glm::vec2& xz) const {
    const float h = height(xz), n = normal(xz).y, patch = noise.fractal({xz.x * 0.006f, 2.5f, xz.y * 0.006f}, 4);
    return glm::smoothstep(-0.12f, 0.22f, patch + 0.1f) * glm::smoothstep(0.62f, 0.78f, n) * glm::smoothstep(treeLine, treeLine - 170, h + 90 * patch) *
           glm::smoothstep(lake + 2, lake + 9, h);
}

Surface Mountains::surface(const glm::vec3& p, const glm::vec3& n) const {
    const float fine = noise.fractal(p * 0.09f, 3, 0.6f), broad = noise.fractal(p * 0.0045f + 11.0f, 3), beds = std::sin(p.y * 0.16f + 5 * broad + 1.5f * fine);
    Surface s;
    s.color = glm::mix(glm::vec3(0.235f, 0.215f, 0.20f), glm::vec3(0.36f, 0.315f, 0.265f), glm::smoothstep(-0.8f, 0.8f, beds + broad));
    s.color *= 1 + 0.35f * fine;
    s.roughness = 0.92f;
    s.height = 2.2f * fine;
    // Scree lies below the faces, meadow where it is flat enough, browner with height.
    cover(s, glm::vec3(0.34f, 0.315f, 0.28f) * (1 + 0.2f * fine), 0.95f, 0.7f * glm::smoothstep(0.60f, 0.76f, n.y + 0.08f * fine));
    const glm::vec3 grass = glm::mix(glm::vec3(0.105f, 0.155f, 0.035f), glm::vec3(0.25f, 0.22f, 0.085f), glm::smoothstep(150.0f, 560.0f, p.y + 150 * broad));
    const float green = glm::smoothstep(0.66f, 0.84f, n.y + 0.10f * fine) * glm::smoothstep(treeLine + 160, treeLine, p.y + 120 * broad);
    cover(s, grass * (1 + 0.3f * fine), 0.95f, green);
    cover(s, glm::vec3(0.05f, 0.065f, 0.022f) * (1 + 0.3f * fine), 0.95f, 0.85f * forest({p.x, p.z}));
    const float shore = glm::smoothstep(lake + 7, lake + 1, p.y + 3 * fine);
    cover(s, {0.33f, 0.30f, 0.25f}, 0.9f, shore);
    // Snow stays where it doesn't slide, more so in the shade of the north.
    const float snow =
        glm::smoothstep(snowLine - 130, snowLine + 60, p.y + 130 * broad + 50 * fine - 110 * n.z) * glm::smoothstep(0.50f, 0.68f, n.y + 0.06f * fine);
    cover(s, {0.86f, 0.88f, 0.91f}, 0.7f, snow);
    return s;
}

Model Mountains::model(Glb& glb, const std::string& name, int cells, int texels) const {
    const Mesh mesh = grid(cells, cells, [&](float u, float v) {
        const glm::vec2 xz = (glm::vec2(u, v) - 0.5f) * size;
        return glm::vec3(xz.x, height(xz), xz.y);
    });
    const Lattice lattice(mesh, cells, cells);
    const Textures pictures =
        paintLattice(lattice, glm::ivec2(texels), glm::vec2(size), [&](const Lattice::Point& q) { return surface(q.position, q.normal); });
    Model model{name, {}};
    model.add(glb.addMaterial(glb.dressed({.name = name}, pictures)), mesh);
    return model;
}

}  // namespace lodestir::generate
