// SPDX-License-Identifier: MIT
// A tree of boxes around triangles on the CPU: the nearest surface point, and all triangles near a point.
#pragma once
#include <framework/core/api.h>

#include <glm/glm.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace lodestir {

/// Keeps a copy of the triangles' corners. Triangles in a plane of UVs are given as (u, v, 0).
class LODESTIR_API TriangleTree {
public:
    TriangleTree(std::span<const glm::vec3> points, std::span<const glm::uvec3> triangles);

    /// Distance from `p` to the nearest point of any triangle; infinite when there are none. What is no farther than `enough` need not be the
    /// nearest: who looks for the largest of many distances has no use for it.
    double distance(const glm::dvec3& p, double enough = 0) const;

    /// The least of square(triangle), which is never below the triangle's squared distance from `p` plus beyond(box) of the boxes it is in; or one
    /// that is no more than `enough`. Boxes too far to hold the least are left out, nearer ones come first. Infinite when there are no triangles.
    template <class Square, class Beyond> double least(const glm::dvec3& p, double enough, const Square& square, const Beyond& beyond) const {
        return search(p, enough, [&](std::uint32_t slot) { return square(order_[slot]); }, beyond);
    }

    std::size_t boxes() const { return nodes_.size(); }
    /// Calls ofTriangle(box, triangle) for what a box without children holds and join(box, child) for others, children first.
    template <class OfTriangle, class Join> void gather(const OfTriangle& ofTriangle, const Join& join) const {
        for (auto box = std::uint32_t(nodes_.size()); box-- > 0;) {
            const Box& b = nodes_[box];
            for (std::uint32_t i = b.first; i < b.first + b.count; ++i) ofTriangle(box, order_[i]);
            for (std::uint32_t child = b.first; b.count == 0 && child < b.first + 2; ++child) join(box, child);
        }
    }

    /// Calls visit(triangle) for each triangle whose box, grown by `margin`, holds `p`.
    template <class Visit> void near(const glm::vec3& p, float margin, const Visit& visit) const {
        std::uint32_t stack[64], depth = 0;
        if (!nodes_.empty()) stack[depth++] = 0;
        while (depth > 0) {
            const Box& box = nodes_[stack[--depth]];
            if (glm::any(glm::lessThan(p, box.low - margin)) || glm::any(glm::greaterThan(p, box.high + margin))) continue;
            if (box.count == 0) {
                stack[depth++] = box.first;
                stack[depth++] = box.first + 1;
            }
            for (std::uint32_t i = box.first; i < box.first + box.count; ++i) visit(order_[i]);
        }
    }

private:
    struct Box {
        glm::vec3 low{0}, high{0};
        std::uint32_t first = 0, count = 0;  ///< triangles of a leaf; count 0: children `first` and `first` + 1
    };
    struct Corners {
        glm::vec3 a, b, c;
    };
    void split(std::uint32_t node, std::span<const glm::vec3> centres);
    static double squaredDistance(const glm::dvec3& p, const Box& box) {
        const glm::dvec3 d = glm::max(glm::max(glm::dvec3(box.low) - p, p - glm::dvec3(box.high)), 0.0);
        return glm::dot(d, d);
    }
    /// The least of square(slot) over places in the tree's order.
    template <class Square, class Beyond> double search(const glm::dvec3& p, double enough, const Square& square, const Beyond& beyond) const {
        double best = std::numeric_limits<double>::infinity();
        struct Entry {
            std::uint32_t node;
            double distance;
        };
        Entry stack[64];
        std::uint32_t depth = 0;
        if (!nodes_.empty()) stack[depth++] = {0, 0};
        while (depth > 0 && !(best <= enough)) {
            const Entry entry = stack[--depth];
            if (entry.distance >= best) continue;
            const Box& box = nodes_[entry.node];
            for (std::uint32_t i = box.first; i < box.first + box.count; ++i) best = std::min(best, double(square(i)));
            if (box.count > 0) continue;
            const auto child = [&](std::uint32_t node) { return Entry{node, squaredDistance(p, nodes_[node]) + beyond(node)}; };
            Entry near = child(box.first), far = child(box.first + 1);
            if (near.distance > far.distance) std::swap(near, far);
            stack[depth++] = far;
            stack[depth++] = near;
        }
        return best;
    }

    std::vector<Box> nodes_;
    std::vector<std::uint32_t> order_;
    std::vector<Corners> corners_;  ///< in the tree's order
};

}  // namespace lodestir
