// SPDX-License-Identifier: MIT
// See tiles.h.
#include "tiles.h"

#include <algorithm>
#include <cmath>

#include "noise.h"
#include "random.h"

namespace lodestir::generate {

Textures paintTiles(const Tiling& t, uint32_t seed, int width) {
    const glm::vec2 size = t.size();
    const int height = int(std::lround(float(width) * size.y / size.x));
    const Noise noise{seed};
    return paint({.width = width, .height = height, .metres = size}, [&](const glm::vec2& p) {
        const float row = std::floor(p.y / t.tile.y);
        const float x = std::fmod(p.x + (t.bond && int(row) % 2 ? t.tile.x / 2 : 0.0f), size.x);
        const glm::vec2 cell(std::floor(x / t.tile.x), row), inside = glm::vec2(x, p.y) - cell * t.tile, off = inside - t.tile * 0.5f;
        Random random(hash(seed, uint32_t(cell.x), uint32_t(cell.y)));
        const float tone = random.bell(), shift = random.between(0, 60);
        const glm::vec2 lean = t.tilt * glm::vec2(random.bell(), random.bell());

        Surface s;
        const glm::vec3 q(off * 6.0f, shift);  // each tile is cut from another place
        s.color = (int(cell.x + cell.y) % 2 ? t.second : t.color) * (1 + t.tone * tone);
        s.color *= 1 + 0.5f * t.tone * noise.fractal(q * 2.0f, 4);
        if (t.veins > 0) {
            const glm::vec3 bent = q + 0.7f * glm::vec3(noise.fractal(q * 0.8f + 7.0f, 3), noise.fractal(q * 0.8f + 19.0f, 3), 0);
            const float vein = std::pow(noise.ridged(bent * 0.55f, 4), 7.0f), cloud = 0.5f + 0.5f * noise.fractal(bent * 0.7f + 31.0f, 4);
            s.color *= 1.0f - glm::clamp(t.veins * (0.8f * vein + 0.25f * cloud * cloud), 0.0f, 0.85f) * glm::vec3(0.96f, 1, 1.03f);
        }
        s.roughness = t.roughness;
        s.height = glm::dot(lean, off) + t.wave * noise.fractal(glm::vec3(off / t.tile.y * 1.3f, shift), 2);

        const glm::vec2 border = t.tile * 0.5f - glm::abs(off) - t.joint / 2;
        const float edge = std::min(border.x, border.y), round = 1 - glm::smoothstep(0.0f, t.edge, edge);
        s.height -= 0.25f * t.edge * round * round;
        if (edge < 0) {
            s.color = t.grout * (1 + 0.15f * noise.fractal(glm::vec3(p * 300.0f, 1.5f), 2));
            s.roughness = 0.9f;
            s.height = -0.3f * t.edge;
        }
        return s;
    });
}

Mesh facing(Mesh mesh, const glm::vec2& size) {
    for (Vertex& v : mesh.vertices) {
        const glm::vec3 n = glm::abs(v.normal), p = v.position;
        v.uv = (n.y > std::max(n.x, n.z) ? glm::vec2(p.x, p.z) : n.x > n.z ? glm::vec2(p.z, -p.y) : glm::vec2(p.x, -p.y)) / size;
    }
    return mesh;
}

}  // namespace lodestir::generate
