// SPDX-License-Identifier: MIT
#include <framework/scene/lod/vertex_fit.h>

#include <framework/core/tasks.h>
#include <framework/scene/lod/appearance_tree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace lodestir {
namespace {

/// Of the area around a vertex: how much it holds on to its own value. Where nothing of the finer level is near, nothing else says what
/// it should be.
constexpr double ownShare = 1e-3;
/// Of a mean of unit normals: below it says nothing about a direction, and the vertex keeps its own.
constexpr double leastDirected = 0.1;
constexpr int sweeps = 40;  ///< mass matrices of triangles have bounded condition (Wathen 1987): each sweep gains a digit in two or three

/// The normal equations of unknowns that meet in triangles.
class Equations {
public:
    explicit Equations(std::size_t unknowns) : rows_(unknowns), right_(unknowns, glm::dvec4(0)) {}

    void add(const std::array<std::uint32_t, 3>& unknowns, const std::array<double, 3>& weights, double area, const glm::dvec4& value) {
        for (std::size_t i = 0; i < 3; ++i) {
            right_[unknowns[i]] += area * weights[i] * value;
            for (std::size_t j = 0; j < 3; ++j) factor(unknowns[i], unknowns[j]) += area * weights[i] * weights[j];
        }
    }
    void addOwn(std::uint32_t unknown, double weight, const glm::dvec4& value) {
        right_[unknown] += weight * value;
        factor(unknown, unknown) += weight;
    }

    /// By Gauss and Seidel, each step clamped to the range: the least under those bounds, since the sum of squares is convex.
    void solve(std::vector<glm::dvec4>& values, const glm::dvec4& low, const glm::dvec4& high) const {
        for (int sweep = 0; sweep < sweeps; ++sweep)
            for (std::size_t i = 0; i < rows_.size(); ++i) {
                double own = 0;
                glm::dvec4 rest = right_[i];
                for (const auto& [j, factor] : rows_[i]) {
                    if (j == i)
                        own = factor;
                    else
                        rest -= factor * values[j];
                }
                if (own > 0) values[i] = glm::clamp(rest / own, low, high);
            }
    }

private:
    double& factor(std::uint32_t row, std::uint32_t column) {
        for (auto& [j, found] : rows_[row])
            if (j == column) return found;
        return rows_[row].emplace_back(column, 0.0).second;
    }

    std::vector<std::vector<std::pair<std::uint32_t, double>>> rows_;
    std::vector<glm::dvec4> right_;
};

glm::dvec3 unitOrZero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return std::isfinite(length) && length > 0 ? v / length : glm::dvec3(0);
}

double areaOf(const MeshLevel& level, const glm::uvec3& t) {
    const glm::dvec3 a(level.positions[t.x]);
    return 0.5 * glm::length(glm::cross(glm::dvec3(level.positions[t.y]) - a, glm::dvec3(level.positions[t.z]) - a));
}

/// Three points a triangle, exact for squares (Strang and Fix 1973).
constexpr std::array<std::array<double, 3>, 3> places{{{2.0 / 3, 1.0 / 6, 1.0 / 6}, {1.0 / 6, 2.0 / 3, 1.0 / 6}, {1.0 / 6, 1.0 / 6, 2.0 / 3}}};

/// Of those points of the finer level, triangle by triangle, the nearest of the coarse one that looks alike in all but colour: the other side of a leaf is
/// near, too.
std::vector<NearestPoint> nearestPoints(const MeshLevel& finer, const std::vector<glm::uvec3>& coarse, const std::vector<std::uint32_t>& groups) {
    const Appearance appearance(finer, Appearance::all & ~unsigned(Appearance::colors));
    const TriangleTree boxes(finer.positions, coarse);
    const AppearanceTree tree(boxes, finer.positions, coarse, appearance);
    std::vector<NearestPoint> nearest(places.size() * finer.triangles.size());
    parallelFor(finer.triangles.size(), 256, [&](std::size_t begin, std::size_t end) {
        std::array<double, Appearance::most> looks{};
        for (std::size_t t = begin; t < end; ++t)
            for (std::size_t i = 0; i < places.size(); ++i) {
                glm::dvec3 position(0);
                looks.fill(0);
                for (int k = 0; k < 3; ++k) {
                    const double weight = places[i][std::size_t(k)];
                    const std::uint32_t vertex = finer.triangles[t][k];
                    position += weight * glm::dvec3(finer.positions[vertex]);
                    for (std::size_t n = 0; n < appearance.size(); ++n) looks[n] += weight * double(appearance.of(vertex)[n]);
                }
                nearest[places.size() * t + i] = tree.nearest(position, std::span(looks).first(appearance.size()),
                                                              [&](std::uint32_t other) { return groups[other] == finer.materials[t]; });
            }
    });
    return nearest;
}

/// Values of the vertices, fitted.
std::vector<glm::dvec4> fit(const MeshLevel& finer, std::vector<glm::dvec4> values, const std::vector<glm::uvec3>& coarse,
                            const std::vector<NearestPoint>& nearest) {
    // One unknown a place and value: a hard edge or the border of a chart must not show as a line.
    std::map<std::array<double, 7>, std::uint32_t> known;
    std::vector<std::uint32_t> unknownOf(values.size(), none);
    std::vector<glm::dvec4> unknowns;
    for (const glm::uvec3& t : coarse)
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 p(finer.positions[t[k]]);
            const glm::dvec4& v = values[t[k]];
            const auto [entry, isNew] = known.try_emplace({p.x, p.y, p.z, v.x, v.y, v.z, v.w}, std::uint32_t(unknowns.size()));
            if (isNew) unknowns.push_back(v);
            unknownOf[t[k]] = entry->second;
        }

    Equations equations(unknowns.size());
    glm::dvec4 low(std::numeric_limits<double>::max()), high(-low);
    for (std::size_t t = 0; t < finer.triangles.size(); ++t) {
        const glm::uvec3& from = finer.triangles[t];
        const double area = areaOf(finer, from) / double(places.size());
        for (int k = 0; k < 3; ++k) {
            low = glm::min(low, values[from[k]]);
            high = glm::max(high, values[from[k]]);
        }
        for (std::size_t i = 0; i < places.size(); ++i) {
            const NearestPoint& point = nearest[places.size() * t + i];
            if (point.triangle == none || !(area > 0)) continue;
            const glm::uvec3& to = coarse[point.triangle];
            const glm::dvec4 value = places[i][0] * values[from.x] + places[i][1] * values[from.y] + places[i][2] * values[from.z];
            equations.add({unknownOf[to.x], unknownOf[to.y], unknownOf[to.z]}, point.weights, area, value);
        }
    }
    for (const glm::uvec3& t : coarse)
        for (int k = 0; k < 3; ++k) equations.addOwn(unknownOf[t[k]], ownShare * areaOf(finer, t) / 3, values[t[k]]);
    equations.solve(unknowns, low, high);
    for (std::size_t v = 0; v < values.size(); ++v)
        if (unknownOf[v] != none) values[v] = unknowns[unknownOf[v]];
    return values;
}

}  // namespace

VertexFit fitVertices(const MeshLevel& finer, const std::vector<glm::uvec3>& coarse, const std::vector<std::uint32_t>& groups) {
    VertexFit result{finer.colors, finer.normals};
    if (coarse.empty() || (finer.colors.empty() && finer.normals.empty())) return result;
    const std::vector<NearestPoint> nearest = nearestPoints(finer, coarse, groups);
    if (!finer.colors.empty()) {
        const std::vector<glm::dvec4> fitted = fit(finer, {finer.colors.begin(), finer.colors.end()}, coarse, nearest);
        std::ranges::transform(fitted, result.colors.begin(), [](const glm::dvec4& v) { return glm::vec4(v); });
    }
    if (finer.normals.empty()) return result;
    std::vector<glm::dvec4> directions;
    for (const glm::vec3& n : finer.normals) directions.emplace_back(unitOrZero(n), 0);
    const std::vector<glm::dvec4> fitted = fit(finer, directions, coarse, nearest);
    for (std::size_t v = 0; v < fitted.size(); ++v)
        if (const glm::dvec3 n(fitted[v]); glm::length(n) > leastDirected) result.normals[v] = glm::vec3(glm::normalize(n));
    return result;
}

}  // namespace lodestir
