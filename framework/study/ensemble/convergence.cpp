// SPDX-License-Identifier: MIT
#include <framework/image/metrics.h>
#include <framework/study/ensemble/convergence.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace lodestir {
namespace {

class Judge {
public:
    explicit Judge(const EnsembleImage& reference) : reference_(reference) {
        const double exposure = exposureOf(firstChannels(reference.image, 3));
        for (std::size_t p = 0; p < reference.image.pixelCount(); ++p) {
            const double r = exposure * reference.luminance(p);
            weights_.push_back(exposure * exposure / (r * r + epsilon));
            floors_.push_back(epsilon / exposure);
        }
    }

    /// Of the mean over these runs.
    double error(const EnsembleImage& runs) const {
        return mean([&](std::size_t p) { return weights_[p] * (square(runs.luminance(p) - reference_.luminance(p)) - reference_.variance(p)); });
    }
    /// Of one of these runs, by their spread.
    double noise(const EnsembleImage& runs) const {
        return runs.runs * mean([&](std::size_t p) { return weights_[p] * runs.variance(p); });
    }
    double bias(const EnsembleImage& runs) const { return error(runs) - noise(runs) / runs.runs; }
    double difference(const EnsembleImage& runs) const {
        return mean([&](std::size_t p) { return std::abs(runs.luminance(p) - reference_.luminance(p)) / (reference_.luminance(p) + floors_[p]); });
    }
    /// The mean of |x| is sqrt(2 / pi) standard deviations of a normal x around 0.
    double differenceOfNoise(const EnsembleImage& runs) const {
        return std::sqrt(2 / std::numbers::pi) *
               mean([&](std::size_t p) { return std::sqrt(runs.variance(p) + reference_.variance(p)) / (reference_.luminance(p) + floors_[p]); });
    }

private:
    static constexpr double epsilon = 0.01;  // that of relmse and mape
    static double square(double x) { return x * x; }
    template <class F> double mean(const F& of) const {
        double sum = 0;
        for (std::size_t p = 0; p < weights_.size(); ++p) sum += of(p);
        return sum / double(weights_.size());
    }

    const EnsembleImage& reference_;
    std::vector<double> weights_, floors_;
};

/// Standard deviation of the bias of all chunks together, by leaving out one after the other (jackknife; Efron and Stein 1981).
double biasDeviation(std::span<const EnsembleImage> chunks, const Judge& judge) {
    constexpr std::size_t fewest = 4;
    const std::size_t count = chunks.size();
    if (count < fewest) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0, squares = 0;
    for (std::size_t left = 0; left < count; ++left) {
        std::vector<EnsembleImage> others(chunks.begin(), chunks.end());
        others.erase(others.begin() + std::ptrdiff_t(left));
        const double bias = judge.bias(joinImages(others));
        sum += bias;
        squares += bias * bias;
    }
    const double n = double(count);
    return std::sqrt(std::max(0.0, (squares - sum * sum / n) * (n - 1) / n));
}

}  // namespace

Convergence convergenceOf(std::span<const EnsembleImage> chunks, const EnsembleImage& reference) {
    const Judge judge(reference);
    const EnsembleImage all = joinImages(chunks);
    Convergence result{.noise = judge.noise(all),
                       .bias = judge.bias(all),
                       .biasDeviation = biasDeviation(chunks, judge),
                       .difference = judge.difference(all),
                       .differenceOfNoise = judge.differenceOfNoise(all)};
    result.points.push_back({1, result.noise + result.bias});
    for (std::size_t count = 1; count < chunks.size(); count *= 2) {
        const EnsembleImage some = joinImages(chunks.first(count));
        result.points.push_back({some.runs, judge.error(some)});
    }
    result.points.push_back({all.runs, judge.error(all)});
    return result;
}

}  // namespace lodestir
