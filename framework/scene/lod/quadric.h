// SPDX-License-Identifier: MIT
// Quadrics over position and UV: the squared distance to triangles and lines that a vertex stands for.
#pragma once
#include <glm/glm.hpp>

#include <array>
#include <cmath>

namespace lodestir {

/// A vertex as a point of five dimensions: position, then UV in the same unit.
using Point5 = std::array<double, 5>;

/// A weighted sum of squared distances to flat pieces in five dimensions, x A x + 2 b x + c (Garland and Heckbert 1998, section 3).
/// Sliding within a triangle costs nothing where its UVs go along; what moves the texture costs like what moves the surface.
class Quadric {
public:
    static Quadric ofTriangle(const Point5& p, const Point5& q, const Point5& r, double weight) {
        const Point5 e = unit(minus(q, p)), side = minus(r, p);
        return flat(p, e, unit(along(side, e, -dot(side, e))), weight);
    }
    /// Of the line through two points.
    static Quadric ofEdge(const Point5& p, const Point5& q, double weight) { return flat(p, unit(minus(q, p)), {}, weight); }

    Quadric& operator+=(const Quadric& other) {
        for (std::size_t i = 0; i < a_.size(); ++i) a_[i] += other.a_[i];
        for (std::size_t i = 0; i < 5; ++i) b_[i] += other.b_[i];
        c_ += other.c_;
        return *this;
    }
    double at(const Point5& x) const {
        double sum = c_;
        for (std::size_t i = 0, k = 0; i < 5; ++i) {
            sum += 2 * b_[i] * x[i];
            for (std::size_t j = i; j < 5; ++j, ++k) sum += (i == j ? 1 : 2) * a_[k] * x[i] * x[j];
        }
        return sum > 0 ? sum : 0;
    }

private:
    static double dot(const Point5& x, const Point5& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2] + x[3] * y[3] + x[4] * y[4]; }
    static Point5 along(Point5 x, const Point5& direction, double t) {
        for (std::size_t i = 0; i < 5; ++i) x[i] += t * direction[i];
        return x;
    }
    static Point5 minus(const Point5& x, const Point5& y) { return along(x, y, -1); }
    static Point5 unit(const Point5& x) {
        const double length = std::sqrt(dot(x, x));
        return length > 0 ? along({}, x, 1 / length) : Point5{};
    }

    /// Squared distance to the flat through p along the orthonormal e and f (f may be zero): |x - p|^2 - ((x - p) e)^2 - ((x - p) f)^2.
    static Quadric flat(const Point5& p, const Point5& e, const Point5& f, double weight) {
        Quadric quadric;
        const double pe = dot(p, e), pf = dot(p, f);
        for (std::size_t i = 0, k = 0; i < 5; ++i) {
            quadric.b_[i] = weight * (pe * e[i] + pf * f[i] - p[i]);
            for (std::size_t j = i; j < 5; ++j, ++k) quadric.a_[k] = weight * ((i == j ? 1 : 0) - e[i] * e[j] - f[i] * f[j]);
        }
        quadric.c_ = weight * (dot(p, p) - pe * pe - pf * pf);
        return quadric;
    }

    std::array<double, 15> a_{};  ///< upper triangle, row by row
    std::array<double, 5> b_{};
    double c_ = 0;
};

}  // namespace lodestir
