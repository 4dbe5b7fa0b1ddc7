// SPDX-License-Identifier: MIT
// What collapses do to attributes: how far a vertex's values are from those that the surface it stands for had there.
#pragma once
#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace lodestir {

/// Of each wedge, a weighted sum over triangles and attributes of (g p + d - s)^2: the difference of value s at position p from the linear
/// field g p + d that the attribute is on the triangle (Hoppe 1999, New quadric metric, section 3). Numbers a wedge grow with the number of
/// attributes, not its square.
class AttributeQuadrics {
public:
    AttributeQuadrics(std::size_t wedges, std::size_t attributes)
        : attributes_(attributes), stride_(10 + 5 * attributes), values_(attributes > 0 ? wedges * stride_ : 0, 0.0) {}

    std::size_t attributes() const { return attributes_; }

    /// Adds a triangle to each of its wedges. value(corner, attribute); attributes from `first` on.
    template <class Value> void addTriangle(const glm::uvec3& wedges, const std::array<glm::dvec3, 3>& corners, double weight,
                                            std::size_t first, const Value& value) {
        const glm::dvec3 e = corners[1] - corners[0], f = corners[2] - corners[0];
        const double ee = glm::dot(e, e), ef = glm::dot(e, f), ff = glm::dot(f, f), determinant = ee * ff - ef * ef;
        if (!(determinant > flattest * ee * ff)) return;  // a sliver: no area, and a slope that means nothing
        for (std::size_t j = first; j < attributes_; ++j) {
            const double s = value(0, j), se = value(1, j) - s, sf = value(2, j) - s;
            const glm::dvec3 g = ((ff * se - ef * sf) * e + (ee * sf - ef * se) * f) / determinant;
            const double d = s - glm::dot(g, corners[0]);
            for (int k = 0; k < 3; ++k) addField(&values_[wedges[k] * stride_], j, g, d, weight);
        }
    }
    void add(std::uint32_t to, std::uint32_t from) {
        for (std::size_t i = 0; attributes_ > 0 && i < stride_; ++i) values_[to * stride_ + i] += values_[from * stride_ + i];
    }
    /// Of a wedge with values at a position.
    double at(std::uint32_t wedge, const glm::dvec3& p, std::span<const double> s) const {
        if (attributes_ == 0) return 0;
        const double* q = &values_[wedge * stride_];
        double sum = q[0] * p.x * p.x + q[1] * p.y * p.y + q[2] * p.z * p.z + 2 * (q[3] * p.x * p.y + q[4] * p.x * p.z + q[5] * p.y * p.z) +
                     2 * (q[6] * p.x + q[7] * p.y + q[8] * p.z) + q[9];
        q += 10;
        for (std::size_t j = 0; j < attributes_; ++j, q += 5)
            sum += s[j] * (q[4] * s[j] - 2 * (q[0] * p.x + q[1] * p.y + q[2] * p.z + q[3]));
        return sum > 0 ? sum : 0;
    }

private:
    static constexpr double flattest = 1e-10;  ///< squared sine of the corner

    static void addField(double* q, std::size_t attribute, const glm::dvec3& g, double d, double weight) {
        q[0] += weight * g.x * g.x, q[1] += weight * g.y * g.y, q[2] += weight * g.z * g.z;
        q[3] += weight * g.x * g.y, q[4] += weight * g.x * g.z, q[5] += weight * g.y * g.z;
        q[6] += weight * d * g.x, q[7] += weight * d * g.y, q[8] += weight * d * g.z;
        q[9] += weight * d * d;
        q += 10 + 5 * attribute;
        q[0] += weight * g.x, q[1] += weight * g.y, q[2] += weight * g.z, q[3] += weight * d, q[4] += weight;
    }

    std::size_t attributes_, stride_;
    std::vector<double> values_;  ///< of each wedge: of p p the 6 products, of p 3, 1; of each attribute: weighted g and d, and the weight
};

}  // namespace lodestir
