// SPDX-License-Identifier: MIT
#include <framework/scene/lod/colors.h>

#include <framework/core/tasks.h>
#include <framework/scene/lod/appearance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace lodestir {
namespace {

/// Of the area around a vertex: how much it holds on to its own colour. Where nothing of the finest level is near, nothing else says what
/// it should be.
constexpr double ownShare = 1e-3;
constexpr int sweeps = 40;  ///< mass matrices of triangles have bounded condition (Wathen 1987): each sweep gains a digit in two or three

/// The normal equations of unknowns that meet in triangles.
class Equations {
public:
    explicit Equations(std::size_t unknowns) : rows_(unknowns), right_(unknowns, glm::dvec4(0)) {}

    void add(const std::array<std::uint32_t, 3>& unknowns, const std::array<double, 3>& weights, double area, const glm::dvec4& color) {
        for (std::size_t i = 0; i < 3; ++i) {
            right_[unknowns[i]] += area * weights[i] * color;
            for (std::size_t j = 0; j < 3; ++j) at(unknowns[i], unknowns[j]) += area * weights[i] * weights[j];
        }
    }
    void addOwn(std::uint32_t unknown, double weight, const glm::dvec4& color) {
        right_[unknown] += weight * color;
        at(unknown, unknown) += weight;
    }

    /// By Gauss and Seidel, each step clamped to the range: the least under those bounds, since the sum of squares is convex.
    void solve(std::vector<glm::dvec4>& colors, const glm::dvec4& low, const glm::dvec4& high) const {
        for (int sweep = 0; sweep < sweeps; ++sweep)
            for (std::size_t i = 0; i < rows_.size(); ++i) {
                double own = 0;
                glm::dvec4 rest = right_[i];
                for (const auto& [j, value] : rows_[i]) {
                    if (j == i)
                        own = value;
                    else
                        rest -= value * colors[j];
                }
                if (own > 0) colors[i] = glm::clamp(rest / own, low, high);
            }
    }

private:
    double& at(std::uint32_t row, std::uint32_t column) {
        for (auto& [j, value] : rows_[row])
            if (j == column) return value;
        return rows_[row].emplace_back(column, 0.0).second;
    }

    std::vector<std::vector<std::pair<std::uint32_t, double>>> rows_;
    std::vector<glm::dvec4> right_;
};

double areaOf(const MeshLevel& level, const glm::uvec3& t) {
    const glm::dvec3 a(level.positions[t.x]);
    return 0.5 * glm::length(glm::cross(glm::dvec3(level.positions[t.y]) - a, glm::dvec3(level.positions[t.z]) - a));
}

}  // namespace

std::vector<glm::vec4> coarseColors(const MeshLevel& finest, const std::vector<glm::uvec3>& coarse,
                                    const std::vector<std::uint32_t>& groups) {
    std::vector<glm::vec4> result = finest.colors;
    if (result.empty() || coarse.empty()) return result;

    // One unknown a place and colour: a hard edge or the border of a chart must not show as a line.
    std::map<std::array<float, 7>, std::uint32_t> known;
    std::vector<std::uint32_t> unknownOf(result.size(), none);
    std::vector<glm::dvec4> colors;
    for (const glm::uvec3& t : coarse)
        for (int k = 0; k < 3; ++k) {
            const glm::vec3& p = finest.positions[t[k]];
            const glm::vec4& c = result[t[k]];
            const auto [entry, isNew] = known.try_emplace({p.x, p.y, p.z, c.r, c.g, c.b, c.a}, std::uint32_t(colors.size()));
            if (isNew) colors.emplace_back(c);
            unknownOf[t[k]] = entry->second;
        }

    // Three points a triangle of the finest level, exact for squares (Strang and Fix 1973), each at the nearest point of the coarse one that
    // looks alike in all but colour: the other side of a leaf is near, too.
    constexpr std::array<std::array<double, 3>, 3> places{
        {{2.0 / 3, 1.0 / 6, 1.0 / 6}, {1.0 / 6, 2.0 / 3, 1.0 / 6}, {1.0 / 6, 1.0 / 6, 2.0 / 3}}};
    const Appearance appearance(finest, Appearance::all & ~unsigned(Appearance::colors));
    const TriangleTree tree(finest.positions, coarse);
    std::vector<NearestPoint> nearest(3 * finest.triangles.size());
    parallelFor(finest.triangles.size(), 256, [&](std::size_t begin, std::size_t end) {
        std::array<double, Appearance::most> looks{};
        for (std::size_t t = begin; t < end; ++t)
            for (std::size_t i = 0; i < 3; ++i) {
                glm::dvec3 position(0);
                looks.fill(0);
                for (int k = 0; k < 3; ++k) {
                    const double weight = places[i][std::size_t(k)];
                    const std::uint32_t vertex = finest.triangles[t][k];
                    position += weight * glm::dvec3(finest.positions[vertex]);
                    for (std::size_t n = 0; n < appearance.size(); ++n) looks[n] += weight * double(appearance.of(vertex)[n]);
                }
                NearestPoint& best = nearest[3 * t + i];
                best.squaredDistance = std::numeric_limits<double>::infinity();
                tree.least(position, [&](std::uint32_t other) {
                    if (groups[other] != finest.materials[t]) return std::numeric_limits<double>::infinity();
                    NearestPoint point =
                        nearestOn(coarse[other], finest.positions, appearance, position, std::span(looks).first(appearance.size()));
                    point.triangle = other;
                    if (point.squaredDistance < best.squaredDistance) best = point;
                    return point.squaredDistance;
                });
            }
    });

    Equations equations(colors.size());
    for (std::size_t t = 0; t < finest.triangles.size(); ++t) {
        const glm::uvec3& from = finest.triangles[t];
        const double area = areaOf(finest, from) / 3;
        for (std::size_t i = 0; i < 3; ++i) {
            const NearestPoint& point = nearest[3 * t + i];
            if (point.triangle == none || !(area > 0)) continue;
            const glm::uvec3& to = coarse[point.triangle];
            const glm::dvec4 color = places[i][0] * glm::dvec4(finest.colors[from.x]) + places[i][1] * glm::dvec4(finest.colors[from.y]) +
                                     places[i][2] * glm::dvec4(finest.colors[from.z]);
            equations.add({unknownOf[to.x], unknownOf[to.y], unknownOf[to.z]}, point.weights, area, color);
        }
    }
    for (const glm::uvec3& t : coarse)
        for (int k = 0; k < 3; ++k) equations.addOwn(unknownOf[t[k]], ownShare * areaOf(finest, t) / 3, glm::dvec4(finest.colors[t[k]]));

    glm::dvec4 low(std::numeric_limits<double>::max()), high(-low);
    for (const glm::uvec3& t : finest.triangles)
        for (int k = 0; k < 3; ++k) {
            low = glm::min(low, glm::dvec4(finest.colors[t[k]]));
            high = glm::max(high, glm::dvec4(finest.colors[t[k]]));
        }
    equations.solve(colors, low, high);
    for (std::size_t v = 0; v < result.size(); ++v)
        if (unknownOf[v] != none) result[v] = glm::vec4(colors[unknownOf[v]]);
    return result;
}

}  // namespace lodestir
