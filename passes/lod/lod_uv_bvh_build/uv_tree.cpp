// SPDX-License-Identifier: MIT
#include "uv_tree.h"

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

struct UvTriangle {
    glm::vec2 low, high;
    std::uint32_t primitive;
};

constexpr std::size_t leafTriangles = 4;

/// Splits at the median of the longer axis, so that the depth is the logarithm of the number of triangles.
void build(UvTrees& trees, std::uint32_t node, std::span<UvTriangle> triangles) {
    UvNode made{triangles[0].low, triangles[0].high, 0, 0};
    for (const UvTriangle& t : triangles) {
        made.low = glm::min(made.low, t.low);
        made.high = glm::max(made.high, t.high);
    }
    if (triangles.size() <= leafTriangles) {
        made.first = std::uint32_t(trees.primitives.size());
        made.count = std::uint32_t(triangles.size());
        for (const UvTriangle& t : triangles) trees.primitives.push_back(t.primitive);
        trees.nodes[node] = made;
        return;
    }
    const glm::vec2 extent = made.high - made.low;
    const int axis = extent.x >= extent.y ? 0 : 1;
    const std::size_t half = triangles.size() / 2;
    std::ranges::nth_element(triangles, triangles.begin() + std::ptrdiff_t(half), [axis](const UvTriangle& a, const UvTriangle& b) {
        const float x = a.low[axis] + a.high[axis], y = b.low[axis] + b.high[axis];
        return x != y ? x < y : a.primitive < b.primitive;
    });
    made.first = std::uint32_t(trees.nodes.size());
    trees.nodes[node] = made;
    trees.nodes.resize(trees.nodes.size() + 2);
    build(trees, made.first, triangles.first(half));
    build(trees, made.first + 1, triangles.subspan(half));
}

}  // namespace

std::uint32_t addUvTree(UvTrees& trees, const MeshLevel& level, std::span<const std::uint32_t> order, std::uint32_t firstPrimitive) {
    if (level.uv0.empty()) return NONE;
    std::vector<UvTriangle> triangles;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const glm::uvec3 corners = level.triangles[order[i]];
        const glm::vec2 a = level.uv0[corners.x], b = level.uv0[corners.y], c = level.uv0[corners.z], e = b - a, f = c - a;
        const float area = std::abs(e.x * f.y - e.y * f.x);
        if (!(area > 0) || !std::isfinite(area)) continue;
        triangles.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), firstPrimitive + std::uint32_t(i)});
    }
    if (triangles.empty()) return NONE;
    const auto root = std::uint32_t(trees.nodes.size());
    trees.nodes.emplace_back();
    build(trees, root, triangles);
    return root;
}

}  // namespace lodestir
