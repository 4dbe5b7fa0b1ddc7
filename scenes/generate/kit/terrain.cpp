// SPDX-License-Identifier: MIT
// Open ground: see terrain.h.
#include "terrain.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "random.h"
#include "shapes.h"

namespace lodestir::generate {

float Terrain::height(const glm::vec2& xz) const {
    const glm::vec3 p(xz.x, 0.5f, xz.y);
    const float r = glm::length(xz);
    const float rolling = 0.35f * noise.fractal(p * 0.11f, 3) * glm::smoothstep(1.0f, 9.0f, r);
    const float lumps = 0.035f * noise.fractal(p * 1.1f + 5.0f, 4, 0.55f);
    const float swell = 2.4f * noise.fractal(p * 0.022f + 9.0f, 4) * glm::smoothstep(8.0f, 60.0f, r);
    const float hills = glm::smoothstep(50.0f, 330.0f, r) * (6 + 46 * noise.ridged(p * 0.0048f + 2.0f, 6, 0.45f));
    // Soil banks up against the rock in the middle.
    const float bank = 0.16f * std::exp(-r * r / 5.5f);
    return rolling + lumps + swell + hills + bank;
}

glm::vec3 Terrain::normal(const glm::vec2& xz) const {
    constexpr float e = 0.05f;
    return glm::normalize(glm::vec3(height(xz - glm::vec2(e, 0)) - height(xz + glm::vec2(e, 0)), 2 * e,
                                    height(xz - glm::vec2(0, e)) - height(xz + glm::vec2(0, e))));
}

float Terrain::meadow(const glm::vec2& xz) const {
    const glm::vec3 p(xz.x, 2.5f, xz.y);
    return glm::smoothstep(-0.22f, 0.30f, noise.fractal(p * 0.34f + 31.0f, 4, 0.6f));
}

Mesh Terrain::mesh(int n) const {
    const auto spread = [](float t) {
        const float a = std::abs(2 * t - 1);
        return (t < 0.5f ? -1.0f : 1.0f) * (13 * a + 387 * a * a * a * a * a);
    };
    Mesh mesh = grid(n, n, [&](float u, float v) {
        const glm::vec2 xz(spread(u), spread(v));
        return glm::vec3(xz.x, height(xz), xz.y);
    });
    for (Vertex& v : mesh.vertices) {
        const glm::vec2 xz(v.position.x, v.position.z);
        v.uv = xz / groundSize;
        const float r = glm::length(xz), grass = meadow(xz);
        const float patch = noise.fractal(glm::vec3(xz * 0.045f, 7.0f), 5, 0.6f);
        // Near by the picture speaks; far off it only modulates a tint of meadow, heath and bare slopes.
        const glm::vec3 soil(0.88f, 0.82f, 0.76f), green(0.72f, 0.86f, 0.46f);
        const glm::vec3 bracken(0.80f, 0.74f, 0.50f), moor(0.40f, 0.56f, 0.33f), heather(0.42f, 0.36f, 0.40f);
        const glm::vec3 heath =
            glm::mix(glm::mix(bracken, moor, glm::smoothstep(-0.30f, 0.12f, patch)), heather, glm::smoothstep(0.10f, 0.42f, patch));
        v.color = glm::mix(glm::mix(soil, green, 0.8f * grass), heath, glm::smoothstep(7.0f, 35.0f, r));
        v.color *= 1 - 0.35f * (1 - glm::smoothstep(0.7f, 0.95f, v.normal.y));
    }
    mesh.hasColors = true;
    return mesh;
}

namespace {

/// Straws strewn over a wrapping square: height above the soil per texel, and which straw it was.
struct Litter {
    int width;
    std::vector<float> height;
    std::vector<uint32_t> straw;

    Litter(uint32_t seed, int texels) : width(texels), height(size_t(texels) * size_t(texels), 0.0f), straw(height.size(), 0u) {
        Random random(seed);
        const float texel = groundSize / float(width);
        for (uint32_t i = 1; i <= 2600; ++i) {
            const float length = random.between(0.04f, 0.16f), heading = random.between(0, 6.2831853f), bow = random.between(-3, 3);
            glm::vec2 p(random.between(0, groundSize), random.between(0, groundSize));
            const float top = random.between(0.0008f, 0.0035f);
            for (float s = 0; s < length; s += texel * 0.6f) {
                const float a = heading + bow * s * 2;
                p += glm::vec2(std::cos(a), std::sin(a)) * texel * 0.6f;
                stamp(glm::ivec2(glm::floor(p / texel)), top, i);
            }
        }
    }

    void stamp(const glm::ivec2& c, float top, uint32_t id) {
        const size_t cell = size_t((c.y % width + width) % width) * size_t(width) + size_t((c.x % width + width) % width);
        if (top > height[cell]) height[cell] = top, straw[cell] = id;
    }
};

}  // namespace

Textures paintGround(uint32_t seed, int width) {
    const Noise broad{seed, {4, 4, 0}}, crumbs{seed + 1, {48, 48, 0}}, grit{seed + 2, {70, 70, 0}};
    const Litter litter(seed + 3, width);
    return paint({.width = width, .height = width, .metres = glm::vec2(groundSize)}, [&](const glm::vec2& p) {
        const glm::vec2 q = p / groundSize;
        const float wide = broad.fractal(glm::vec3(q * 4.0f, 0.5f), 5, 0.55f);
        const float crumb = crumbs.fractal(glm::vec3(q * 48.0f, 0.5f), 3, 0.6f);
        Surface s;
        s.color = glm::mix(glm::vec3(0.155f, 0.105f, 0.064f), glm::vec3(0.235f, 0.18f, 0.115f),
                           glm::smoothstep(-0.4f, 0.5f, wide + 0.4f * crumb));
        s.color *= 1 + 0.25f * crumb;
        s.roughness = 0.95f;
        s.height = 0.006f * wide + 0.0045f * crumb;

        // Grit: a share of the cells holds a small stone, half sunk.
        const Cell cell = grit.cell(glm::vec3(q * 70.0f, 0.5f));
        const float size = 0.18f + 0.30f * unit(hash(cell.id, 1));
        if (unit(hash(cell.id, 2)) < 0.24f && cell.nearest < size) {
            const float dome = std::sqrt(1 - (cell.nearest / size) * (cell.nearest / size));
            s.color =
                glm::mix(glm::vec3(0.20f, 0.18f, 0.16f), glm::vec3(0.38f, 0.34f, 0.29f), unit(hash(cell.id, 3))) * (0.75f + 0.25f * dome);
            s.roughness = 0.8f;
            s.height += 0.010f * size * dome;
        }

        const glm::ivec2 texel = glm::ivec2(q * float(width));
        const size_t at = size_t(std::min(texel.y, width - 1)) * size_t(width) + size_t(std::min(texel.x, width - 1));
        if (const uint32_t straw = litter.straw[at]; straw != 0) {
            s.color = glm::mix(glm::vec3(0.22f, 0.17f, 0.075f), glm::vec3(0.52f, 0.42f, 0.22f), unit(hash(straw, 9)));
            s.roughness = 0.7f;
            s.height += litter.height[at];
        }
        return s;
    });
}

}  // namespace lodestir::generate
