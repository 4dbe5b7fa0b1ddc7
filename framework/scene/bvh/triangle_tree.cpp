// SPDX-License-Identifier: MIT
#include <framework/scene/bvh/triangle_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace lodestir {
namespace {

constexpr std::uint32_t leafSize = 4;

/// Squared distance to a triangle, by the region of the plane that the point projects to (Ericson 2005, section 5.1.5).
double squaredDistanceToTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto toSegment = [&](const glm::dvec3& from, const glm::dvec3& to) {
        const glm::dvec3 edge = to - from;
        const double length = glm::dot(edge, edge), t = length > 0 ? std::clamp(glm::dot(p - from, edge) / length, 0.0, 1.0) : 0.0;
        const glm::dvec3 d = p - (from + t * edge);
        return glm::dot(d, d);
    };
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double area = glm::dot(normal, normal);
    const bool inside = area > 0 && glm::dot(glm::cross(b - a, p - a), normal) >= 0 && glm::dot(glm::cross(c - b, p - b), normal) >= 0 &&
                        glm::dot(glm::cross(a - c, p - c), normal) >= 0;
    if (!inside) return std::min({toSegment(a, b), toSegment(b, c), toSegment(c, a)});
    const double height = glm::dot(p - a, normal);
    return height * height / area;
}

}  // namespace

TriangleTree::TriangleTree(std::span<const glm::vec3> points, std::span<const glm::uvec3> triangles) : order_(triangles.size()) {
    if (triangles.empty()) return;
    std::iota(order_.begin(), order_.end(), 0u);
    std::vector<glm::vec3> centres;
    for (const glm::uvec3& t : triangles) {
        corners_.push_back({points[t.x], points[t.y], points[t.z]});
        centres.push_back((points[t.x] + points[t.y] + points[t.z]) / 3.0f);
    }
    nodes_.push_back({.first = 0, .count = std::uint32_t(triangles.size())});
    split(0, centres);
    std::vector<Corners> sorted;
    for (std::uint32_t t : order_) sorted.push_back(corners_[t]);
    corners_ = std::move(sorted);
}

void TriangleTree::split(std::uint32_t node, std::span<const glm::vec3> centres) {
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low), lowCentre(low), highCentre(high);
    const std::uint32_t first = nodes_[node].first, count = nodes_[node].count;
    for (std::uint32_t i = first; i < first + count; ++i) {
        const Corners& t = corners_[order_[i]];
        low = glm::min(low, glm::min(t.a, glm::min(t.b, t.c)));
        high = glm::max(high, glm::max(t.a, glm::max(t.b, t.c)));
        lowCentre = glm::min(lowCentre, centres[order_[i]]);
        highCentre = glm::max(highCentre, centres[order_[i]]);
    }
    nodes_[node].low = low;
    nodes_[node].high = high;
    if (count <= leafSize) return;
    const glm::vec3 extent = highCentre - lowCentre;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const auto begin = order_.begin() + first, middle = begin + count / 2;
    std::nth_element(begin, middle, begin + count, [&](std::uint32_t a, std::uint32_t b) {
        return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis] : a < b;
    });
    const auto children = std::uint32_t(nodes_.size());
    nodes_.push_back({.first = first, .count = count / 2});
    nodes_.push_back({.first = first + count / 2, .count = count - count / 2});
    nodes_[node].first = children;
    nodes_[node].count = 0;
    split(children, centres);
    split(children + 1, centres);
}

double TriangleTree::distance(const glm::dvec3& p, double enough) const {
    const auto square = [&](std::uint32_t slot) { return squaredDistanceToTriangle(p, corners_[slot].a, corners_[slot].b, corners_[slot].c); };
    return std::sqrt(search(p, enough * enough, square, [](std::uint32_t) { return 0.0; }));
}

}  // namespace lodestir
