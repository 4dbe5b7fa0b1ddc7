// SPDX-License-Identifier: MIT
#include <framework/study/ensemble/moments.h>
#include <framework/study/error/statistics.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lodestir {
namespace {

/// I_x(a, b), the regularised incomplete beta function, by its continued fraction (DLMF 8.17.22) and Lentz's method.
double incompleteBeta(double x, double a, double b) {
    if (x <= 0) return 0;
    if (x >= 1) return 1;
    if (x > (a + 1) / (a + b + 2)) return 1 - incompleteBeta(1 - x, b, a);  // where the fraction converges fast
    const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x)) / a;
    constexpr double tiny = 1e-300;
    double c = 1, d = 1 - (a + b) * x / (a + 1);
    d = 1 / (std::abs(d) < tiny ? tiny : d);
    double fraction = d;
    for (int m = 1; m < 500; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
                     odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        double change = 1;
        for (const double term : {even, odd}) {
            d = 1 + term * d;
            d = 1 / (std::abs(d) < tiny ? tiny : d);
            c = 1 + term / c;
            if (std::abs(c) < tiny) c = tiny;
            change = c * d;
            fraction *= change;
        }
        if (std::abs(change - 1) < 1e-14) break;
    }
    return front * fraction;
}

}  // namespace

void Moments::add(double value) { merge({.count = 1, .mean = value}); }

void Moments::merge(const Moments& other) {
    if (other.count == 0) return;
    const double total = count + other.count, shift = other.mean - mean, share = other.count / total;
    cubes += other.cubes + shift * shift * shift * count * share * (count - other.count) / total +
             3 * shift * (count * other.squares - other.count * squares) / total;
    squares += other.squares + shift * shift * count * share;
    mean += shift * share;
    count = total;
}

Moments momentsOf(std::span<const double> values) {
    Moments m{.count = double(values.size())};
    for (const double value : values) m.mean += value / m.count;
    for (const double value : values) {
        const double d = value - m.mean;
        m.squares += d * d;
        m.cubes += d * d * d;
    }
    return m;
}

double studentTail(double t, double freedom) { return incompleteBeta(freedom / (freedom + t * t), 0.5 * freedom, 0.5); }

double MeanTest::halfWidth() const { return studentQuantile(0.975, std::clamp(int(freedom), 1, 1000)) * error; }

MeanTest compareMeans(const Moments& x, const Moments& y, double resolution) {
    MeanTest test{.difference = x.mean - y.mean};
    const double vx = x.variance() / x.count, vy = y.variance() / y.count, variance = vx + vy + resolution * resolution;
    test.error = std::sqrt(variance);
    if (!std::isfinite(test.difference) || !std::isfinite(variance)) {
        test.t = std::numeric_limits<double>::quiet_NaN();
        test.p = 0;
        return test;
    }
    if (variance == 0) {
        test.freedom = x.count + y.count - 2;
        if (test.difference != 0) test.t = std::copysign(std::numeric_limits<double>::infinity(), test.difference), test.p = 0;
        return test;
    }
    // The resolution is no estimate: it is known.
    const double spread = vx * vx / (x.count - 1) + vy * vy / (y.count - 1);
    test.freedom = std::min(1e6, spread > 0 ? variance * variance / spread : 1e6);
    const double t = test.difference / test.error;
    const double third = x.cubes / (x.count * x.count * x.count) - y.cubes / (y.count * y.count * y.count),
                 a = third / (variance * test.error);
    test.t = t + a / 6 + a * t * t / 3 + a * a * t * t * t / 27;
    test.p = studentTail(test.t, test.freedom);
    return test;
}

}  // namespace lodestir
