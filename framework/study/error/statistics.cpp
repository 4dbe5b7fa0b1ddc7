// SPDX-License-Identifier: MIT
#include <framework/study/error/statistics.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace lodestir {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// P(|T| <= t): the finite series for whole degrees of freedom (Abramowitz and Stegun, 26.7.3 and 26.7.4).
double studentCentre(double t, int freedom) {
    const double angle = std::atan(t / std::sqrt(double(freedom))), s = std::sin(angle), c = std::cos(angle);
    const bool odd = freedom % 2 == 1;
    double term = odd ? c : 1, sum = 0;
    for (int i = odd ? 1 : 0; i <= freedom - 2; i += 2) {
        sum += term;
        term *= c * c * (i + 1) / (i + 2);
    }
    return odd ? 2 / std::numbers::pi * (angle + s * sum) : s * sum;
}

}  // namespace

double studentQuantile(double probability, int freedom) {
    const double centre = std::abs(2 * probability - 1);
    double low = 0, high = 1;
    while (studentCentre(high, freedom) < centre && high < 1e15) high *= 2;
    for (int i = 0; i < 200 && high - low > 1e-14 * high; ++i) {
        const double middle = (low + high) / 2;
        (studentCentre(middle, freedom) < centre ? low : high) = middle;
    }
    return probability < 0.5 ? -high : high;
}

Estimate estimateMean(std::span<const double> values) {
    Estimate estimate{.mean = nan, .halfWidth = nan, .count = int(values.size())};
    if (values.empty()) return estimate;
    const double n = double(values.size());
    estimate.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    if (values.size() < 2) return estimate;
    double squares = 0;
    for (const double value : values) squares += (value - estimate.mean) * (value - estimate.mean);
    estimate.halfWidth = studentQuantile(0.975, estimate.count - 1) * std::sqrt(squares / (n - 1) / n);
    return estimate;
}

Estimate withSharedError(Estimate estimate, double deviation) {
    if (estimate.count < 2 || !(deviation > 0)) return estimate;
    const double spread = estimate.halfWidth / studentQuantile(0.975, estimate.count - 1), own = spread * spread,
                 shared = deviation * deviation;
    constexpr double most = 1000;  // as good as infinitely many
    const double freedom = own > 0 ? (own + shared) * (own + shared) / (own * own / (estimate.count - 1)) : most;
    estimate.halfWidth = studentQuantile(0.975, int(std::min(freedom, most))) * std::sqrt(own + shared);
    return estimate;
}

Estimate estimateRatio(std::span<const double> numerators, std::span<const double> denominators) {
    const double numerator = estimateMean(numerators).mean, denominator = estimateMean(denominators).mean, ratio = numerator / denominator;
    std::vector<double> residuals;
    for (std::size_t i = 0; i < numerators.size(); ++i) residuals.push_back((numerators[i] - ratio * denominators[i]) / denominator);
    return {.mean = ratio, .halfWidth = estimateMean(residuals).halfWidth, .count = int(numerators.size())};
}

double medianOf(std::vector<double> values) {
    if (values.empty()) return nan;
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

}  // namespace lodestir
