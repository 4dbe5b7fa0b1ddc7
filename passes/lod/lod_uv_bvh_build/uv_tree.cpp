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

/// Adds the tree of a level and returns its root.
std::uint32_t addTree(UvTrees& trees, const SceneRecords& scene, const LevelRecord& level) {
    std::vector<UvTriangle> triangles;
    for (std::uint32_t i = level.firstPrimitive; i < level.firstPrimitive + level.primitiveCount; ++i) {
        const PrimitiveRecord& corners = scene.primitives[i];
        const glm::vec2 a = scene.vertices[corners.v0].uv0, b = scene.vertices[corners.v1].uv0, c = scene.vertices[corners.v2].uv0, e = b - a, f = c - a;
        const float area = std::abs(e.x * f.y - e.y * f.x);
        if (!(area > 0) || !std::isfinite(area)) continue;
        triangles.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), i});
    }
    if (triangles.empty()) return NONE;
    const auto root = std::uint32_t(trees.nodes.size());
    trees.nodes.emplace_back();
    build(trees, root, triangles);
    return root;
}

}  // namespace

UvTrees uvTrees(const SceneRecords& scene) {
    UvTrees trees;
    trees.roots.assign(scene.meshLevels.size(), NONE);
    for (std::size_t mesh = 0; mesh < scene.meshLevels.size(); mesh += LEVELS) {
        const auto levels = scene.meshLevels.subspan(mesh, LEVELS);
        const auto repeats = [&](std::size_t l) {
            return levels[l].firstPrimitive == levels[l - 1].firstPrimitive && levels[l].primitiveCount == levels[l - 1].primitiveCount;
        };
        if (repeats(1)) continue;  // there is but one
        for (std::size_t l = 0; l < LEVELS; ++l)
            trees.roots[mesh + l] = l > 0 && repeats(l) ? trees.roots[mesh + l - 1] : addTree(trees, scene, levels[l]);
    }
    return trees;
}

}  // namespace lodestir
