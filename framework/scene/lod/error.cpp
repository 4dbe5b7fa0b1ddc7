// SPDX-License-Identifier: MIT
#include <framework/scene/lod/error.h>

#include <framework/core/tasks.h>
#include <framework/scene/lod/appearance_tree.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace lodestir {
namespace {

constexpr std::size_t spreadPoints = 20'000;
constexpr float onEdge = 1e-4f;  ///< barycentric slack: borders of charts are the same lines cut at other places

/// A point of a triangle and the share of the surface that it stands for.
struct SurfacePoint {
    std::uint32_t triangle;
    glm::vec3 weights;  ///< barycentric
};

template <class V> V at(const std::vector<V>& values, const glm::uvec3& t, const glm::vec3& w) {
    return values[t.x] * w.x + values[t.y] * w.y + values[t.z] * w.z;
}

/// Points spread evenly by area: one in each of `count` equal slices of the running area, placed by the R2 sequence (Roberts 2018).
std::vector<SurfacePoint> spread(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles, std::size_t count) {
    std::vector<double> sums;
    double total = 0;
    for (const glm::uvec3& t : triangles) {
        total += glm::length(glm::cross(glm::dvec3(positions[t.y] - positions[t.x]), glm::dvec3(positions[t.z] - positions[t.x])));
        sums.push_back(total);
    }
    std::vector<SurfacePoint> points;
    if (!(total > 0)) return points;
    std::size_t triangle = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double place = (double(i) + 0.5) / double(count) * total;
        while (triangle + 1 < sums.size() && sums[triangle] < place) ++triangle;
        double x = std::fmod(0.5 + 0.7548776662466927 * double(i), 1.0), y = std::fmod(0.5 + 0.5698402909980532 * double(i), 1.0);
        if (x + y > 1) x = 1 - x, y = 1 - y;
        points.push_back({std::uint32_t(triangle), glm::vec3(1 - x - y, x, y)});
    }
    return points;
}

/// Of distance(i, enough), where one that is no more than `enough` need not be exact. The same whichever thread takes which.
template <class Distance> double largest(std::size_t count, const Distance& distance) {
    std::atomic<double> most = 0;
    parallelFor(count, 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            double known = most;
            const double found = distance(i, known);
            while (found > known && !most.compare_exchange_weak(known, found)) {}
        }
    });
    return most;
}

/// Largest distance from a level's vertices, triangle centres and spread points to a surface.
float farthest(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles, const std::vector<SurfacePoint>& points,
               const TriangleTree& surface) {
    std::vector<glm::vec3> places;
    std::vector<bool> used(positions.size(), false);
    for (const glm::uvec3& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            if (!used[t[k]]) places.push_back(positions[t[k]]);
            used[t[k]] = true;
        }
        places.push_back(at(positions, t, glm::vec3(1.0f / 3)));
    }
    for (const SurfacePoint& p : points) places.push_back(at(positions, triangles[p.triangle], p.weights));
    return float(largest(places.size(), [&](std::size_t i, double enough) { return surface.distance(glm::dvec3(places[i]), enough); }));
}

/// Largest distance in space and appearance from points of a level to the other.
float leastAlike(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles, const Appearance& appearance,
                 const std::vector<SurfacePoint>& points, const std::vector<glm::uvec3>& others, const Appearance& othersAppearance,
                 const TriangleTree& surface) {
    const AppearanceTree tree(surface, positions, others, othersAppearance);
    return float(largest(points.size(), [&](std::size_t i, double enough) {
        std::array<double, Appearance::most> numbers{};
        const auto looks = std::span(numbers).first(appearance.size());
        const glm::uvec3& t = triangles[points[i].triangle];
        glm::dvec3 place(0);
        for (int k = 0; k < 3; ++k) {
            const double weight = points[i].weights[k];
            place += weight * glm::dvec3(positions[t[k]]);
            for (std::size_t n = 0; n < looks.size(); ++n) looks[n] += weight * double(appearance.of(t[k])[n]);
        }
        return std::sqrt(tree.nearest(place, looks, [](std::uint32_t) { return true; }, enough).squaredDistance);
    }));
}

/// Barycentric weights of a point in a triangle of the UV plane; none when it lies outside or the triangle has no area.
std::optional<glm::vec3> weightsIn(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const auto cross = [](const glm::dvec2& x, const glm::dvec2& y) { return x.x * y.y - x.y * y.x; };
    const double area = cross(b - a, c - a);
    if (area == 0) return std::nullopt;
    const glm::dvec3 w(cross(b - p, c - p) / area, cross(c - p, a - p) / area, cross(a - p, b - p) / area);
    if (!(w.x >= -onEdge && w.y >= -onEdge && w.z >= -onEdge)) return std::nullopt;
    return glm::vec3(w);
}

/// Distance from each point to the nearest point of the other level that has its UV; infinite where there is none.
std::vector<float> drifts(const MeshLevel& level, const std::vector<glm::vec3>& uvs, const std::vector<glm::uvec3>& triangles,
                          const std::vector<SurfacePoint>& points, const std::vector<glm::uvec3>& others, const TriangleTree& chart) {
    std::vector<float> distances(points.size(), std::numeric_limits<float>::infinity());
    parallelFor(points.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const glm::uvec3& t = triangles[points[i].triangle];
            const glm::vec3 place = at(level.positions, t, points[i].weights), uv = at(uvs, t, points[i].weights);
            chart.near(uv, 1e-6f * std::max({1.0f, std::abs(uv.x), std::abs(uv.y)}), [&](std::uint32_t other) {
                const glm::uvec3& o = others[other];
                const auto weights = weightsIn(glm::dvec2(uv), glm::dvec2(uvs[o.x]), glm::dvec2(uvs[o.y]), glm::dvec2(uvs[o.z]));
                if (weights) distances[i] = std::min(distances[i], glm::distance(place, at(level.positions, o, *weights)));
            });
        }
    });
    return distances;
}

float shareLost(const std::vector<float>& distances) {
    const auto lost = std::ranges::count_if(distances, [](float d) { return !std::isfinite(d); });
    return distances.empty() ? 0.0f : float(lost) / float(distances.size());
}

}  // namespace

bool hasUsefulUvs(const MeshLevel& level) {
    return std::ranges::any_of(level.triangles, [&](const glm::uvec3& t) {
        if (level.uv0.empty()) return false;
        const glm::vec2 e = level.uv0[t.y] - level.uv0[t.x], f = level.uv0[t.z] - level.uv0[t.x];
        return e.x * f.y - e.y * f.x != 0;
    });
}

std::vector<float> distancesToFinest(const std::vector<MeshLevel>& levels) {
    const auto oneWay = [](const MeshLevel& from, const std::vector<SurfacePoint>& points, const TriangleTree& to) {
        return farthest(from.positions, from.triangles, points, to);
    };
    const auto pointsOf = [](const MeshLevel& level) { return spread(level.positions, level.triangles, spreadPoints); };
    const MeshLevel& finest = levels.front();
    const TriangleTree surface(finest.positions, finest.triangles);
    const std::vector<SurfacePoint> points = pointsOf(finest);
    std::vector<float> distances{0};
    for (std::size_t i = 1; i < levels.size(); ++i)
        distances.push_back(std::max(oneWay(levels[i], pointsOf(levels[i]), surface),
                                     oneWay(finest, points, TriangleTree(levels[i].positions, levels[i].triangles))));
    return distances;
}

LodReference::LodReference(const MeshLevel& finest)
    : finest_(finest), surface_(finest.positions, finest.triangles), appearance_(finest, Appearance::all) {
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const glm::uvec3& t : finest.triangles)
        for (int k = 0; k < 3; ++k) {
            low = glm::min(low, finest.positions[t[k]]);
            high = glm::max(high, finest.positions[t[k]]);
        }
    for (const glm::uvec3& t : finest.triangles)
        for (int k = 0; k < 3; ++k) radius_ = std::max(radius_, glm::distance(finest.positions[t[k]], 0.5f * (low + high)));
    if (!hasUsefulUvs(finest)) return;
    for (const glm::vec2& uv : finest.uv0) uvs_.emplace_back(uv, 0);
    chart_.emplace(uvs_, finest.triangles);
}

LodError LodReference::measure(const std::vector<glm::uvec3>& coarse, const VertexFit& looks) const {
    const auto coarsePoints = spread(finest_.positions, coarse, spreadPoints);
    const auto finestPoints = spread(finest_.positions, finest_.triangles, spreadPoints);
    LodError error;
    error.toFinest = farthest(finest_.positions, coarse, coarsePoints, surface_);
    const TriangleTree coarseSurface(finest_.positions, coarse);
    error.fromFinest = farthest(finest_.positions, finest_.triangles, finestPoints, coarseSurface);
    if (appearance_.size() > 0) {
        Appearance painted = appearance_;
        painted.paint(looks.colors);
        painted.turn(looks.normals);
        error.appearance =
            std::max(leastAlike(finest_.positions, coarse, painted, coarsePoints, finest_.triangles, appearance_, surface_),
                     leastAlike(finest_.positions, finest_.triangles, appearance_, finestPoints, coarse, painted, coarseSurface));
    }
    if (!hasUvs()) return error;

    std::vector<float> distances = drifts(finest_, uvs_, coarse, coarsePoints, finest_.triangles, *chart_);
    error.uvLostCoarse = shareLost(distances);
    error.uvLostFinest = shareLost(drifts(finest_, uvs_, finest_.triangles, finestPoints, coarse, TriangleTree(uvs_, coarse)));
    std::erase_if(distances, [](float d) { return !std::isfinite(d); });
    if (distances.empty()) return error;
    std::ranges::sort(distances);
    double sum = 0;
    for (float d : distances) sum += d;
    error.uvMean = float(sum / double(distances.size()));
    error.uv99 = distances[(distances.size() - 1) * 99 / 100];
    error.uvLargest = distances.back();
    return error;
}

}  // namespace lodestir
