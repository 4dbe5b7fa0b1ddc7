// SPDX-License-Identifier: MIT
// The nearest point of a surface in space and appearance together.
#pragma once
#include <framework/scene/lod/appearance.h>

#include <limits>

namespace lodestir {

/// A tree around triangles that knows how what they hold looks, so that a search passes over what is near but looks otherwise: the other side of a leaf.
/// Refers to what it is made of.
class LODESTIR_API AppearanceTree {
public:
    AppearanceTree(const TriangleTree& tree, const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                   const Appearance& appearance);

    /// Of the triangles that accept(triangle) takes; without one the triangle is none and the distance infinite. `looks`: as many numbers as the
    /// appearance has. What is no farther than `enough` need not be the nearest.
    template <class Accept>
    NearestPoint nearest(const glm::dvec3& position, std::span<const double> looks, const Accept& accept, double enough = 0) const {
        NearestPoint best{.squaredDistance = std::numeric_limits<double>::infinity()};
        tree_.least(
            position, enough * enough,
            [&](std::uint32_t triangle) {
                if (!accept(triangle)) return std::numeric_limits<double>::infinity();
                NearestPoint point = nearestOn(triangles_[triangle], positions_, appearance_, position, looks);
                point.triangle = triangle;
                if (point.squaredDistance < best.squaredDistance) best = point;
                return point.squaredDistance;
            },
            [&](std::uint32_t box) { return squaredDistance(looks, box); });
        return best;
    }

private:
    /// From looks to the range of those in a box.
    double squaredDistance(std::span<const double> looks, std::uint32_t box) const {
        const float* low = bounds_.data() + 2 * looks.size() * box;
        const float* high = low + looks.size();
        double sum = 0;
        for (std::size_t n = 0; n < looks.size(); ++n) {
            const double d = std::max({double(low[n]) - looks[n], looks[n] - double(high[n]), 0.0});
            sum += d * d;
        }
        return sum;
    }

    const TriangleTree& tree_;
    const std::vector<glm::vec3>& positions_;
    const std::vector<glm::uvec3>& triangles_;
    const Appearance& appearance_;
    std::vector<float> bounds_;  ///< of each box of the tree the lowest numbers and the highest
};

}  // namespace lodestir
