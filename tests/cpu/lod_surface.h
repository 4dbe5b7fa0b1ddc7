// SPDX-License-Identifier: MIT
// Surfaces with known answers for tests of levels of detail.
#pragma once
#include <framework/scene/scene.h>

#include <functional>
#include <map>
#include <tuple>
#include <utility>

namespace lodestir {

/// columns x rows quads over [0,1]^2 with UVs (u, v); vertices are shared.
inline MeshLevel gridSurface(int columns, int rows, const std::function<glm::vec3(float u, float v)>& at) {
    MeshLevel level;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x) {
            const glm::vec2 uv(float(x) / float(columns), float(y) / float(rows));
            level.positions.push_back(at(uv.x, uv.y));
            level.uv0.push_back(uv);
        }
    const auto stride = std::uint32_t(columns + 1);
    for (std::uint32_t y = 0; y < std::uint32_t(rows); ++y)
        for (std::uint32_t x = 0; x < std::uint32_t(columns); ++x) {
            const std::uint32_t a = y * stride + x;
            level.triangles.push_back({a, a + stride + 1, a + 1});
            level.triangles.push_back({a, a + stride, a + stride + 1});
        }
    level.materials.assign(level.triangles.size(), 0);
    return level;
}

/// A unit sphere as an octahedron halved `times` times; no UVs.
inline MeshLevel octahedralSphere(int times) {
    MeshLevel level;
    level.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    level.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int i = 0; i < times; ++i) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        std::vector<glm::uvec3> finer;
        for (const glm::uvec3& t : level.triangles) {
            glm::uvec3 m;
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = t[k], b = t[(k + 1) % 3];
                const auto [entry, isNew] = middles.try_emplace({std::min(a, b), std::max(a, b)}, std::uint32_t(level.positions.size()));
                if (isNew) level.positions.push_back(glm::normalize(level.positions[a] + level.positions[b]));
                m[k] = entry->second;
            }
            finer.insert(finer.end(), {{t.x, m.x, m.z}, {m.x, t.y, m.y}, {m.z, m.y, t.z}, m});
        }
        level.triangles = finer;
    }
    level.materials.assign(level.triangles.size(), 0);
    return level;
}

/// Edges between positions, and how many triangles use each.
inline std::map<std::vector<float>, int> edgeUses(const MeshLevel& level, const std::vector<glm::uvec3>& triangles) {
    std::map<std::vector<float>, int> uses;
    for (const glm::uvec3& t : triangles)
        for (int k = 0; k < 3; ++k) {
            glm::vec3 a = level.positions[t[k]], b = level.positions[t[(k + 1) % 3]];
            if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(a, b);
            ++uses[{a.x, a.y, a.z, b.x, b.y, b.z}];
        }
    return uses;
}

inline double uvAreaOf(const MeshLevel& level, const glm::uvec3& t) {
    const glm::dvec2 a(level.uv0[t.x]), e = glm::dvec2(level.uv0[t.y]) - a, f = glm::dvec2(level.uv0[t.z]) - a;
    return e.x * f.y - e.y * f.x;
}

}  // namespace lodestir
