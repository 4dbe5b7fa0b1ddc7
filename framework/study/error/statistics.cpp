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

Estimate estimateDifference(std::span<const double> values, std::span<const double> baseline) {
    const Estimate a = estimateMean(values), b = estimateMean(baseline);
    Estimate difference{.mean = a.mean - b.mean, .halfWidth = nan, .count = a.count + b.count};
    if (a.count < 2 || b.count < 2) return difference;
    const double spreadA = a.halfWidth / studentQuantile(0.975, a.count - 1), spreadB = b.halfWidth / studentQuantile(0.975, b.count - 1);
    const double varianceA = spreadA * spreadA, varianceB = spreadB * spreadB, variance = varianceA + varianceB;
    difference.halfWidth = 0;
    if (!(variance > 0)) return difference;
    const double freedom = variance * variance / (varianceA * varianceA / (a.count - 1) + varianceB * varianceB / (b.count - 1));
    difference.halfWidth = studentQuantile(0.975, std::max(1, int(freedom))) * std::sqrt(variance);
    return difference;
}

Estimate estimatePairedDifference(std::span<const double> values, std::span<const double> baseline) {
    std::vector<double> differences;
    for (std::size_t i = 0; i < values.size(); ++i) differences.push_back(values[i] - baseline[i]);
    return estimateMean(differences);
}

Estimate estimateExponent(std::span<const double> x, const std::vector<std::vector<double>>& runs) {
    std::vector<double> logs, slopes;
    for (const double value : x) logs.push_back(std::log(value));
    const double centre = estimateMean(logs).mean;
    double width = 0;
    for (const double value : logs) width += (value - centre) * (value - centre);
    for (const std::vector<double>& run : runs) {
        double sum = 0;
        for (std::size_t i = 0; i < logs.size(); ++i) sum += (logs[i] - centre) * std::log(run[i]);
        slopes.push_back(sum / width);
    }
    return estimateMean(slopes);
}

Estimate estimateJackknife(double whole, std::span<const double> without) {
    const auto n = double(without.size());
    Estimate estimate{.mean = whole, .halfWidth = nan, .count = int(without.size())};
    if (without.size() < 2) return estimate;
    const double middle = estimateMean(without).mean;
    double squares = 0;
    for (const double value : without) squares += (value - middle) * (value - middle);
    estimate.halfWidth = studentQuantile(0.975, estimate.count - 1) * std::sqrt(squares * (n - 1) / n);
    return estimate;
}

double medianOf(std::vector<double> values) {
    if (values.empty()) return nan;
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

}  // namespace lodestir
