// SPDX-License-Identifier: MIT
// Are two sets of independent frames estimates of the same image? Student's t over frames of block means and of the whole energy.
// Blocks, because pixels have heavy tails and means of many pixels don't; over frames, because frames are independent and pixels
// needn't be.
#pragma once
#include <framework/image/image.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace lodestir::test {

/// Mean of samples and the variance of that mean.
struct Mean {
    double value = 0, variance = 0;
    double count = 0;
};

inline Mean meanOf(const std::vector<double>& samples) {
    Mean mean{.count = static_cast<double>(samples.size())};
    for (const double x : samples) mean.value += x / mean.count;
    for (const double x : samples) mean.variance += (x - mean.value) * (x - mean.value) / (mean.count * (mean.count - 1));
    return mean;
}

/// P(|T| > |t|) for Student's distribution: integral of the density by Simpson's rule in the angle atan(t / sqrt(n)),
/// where it is cos^(n-1).
inline double studentTail(double t, double n) {
    const double from = std::atan(std::abs(t) / std::sqrt(n)), to = std::asin(1.0);
    constexpr int steps = 2000;
    double tail = 0, whole = 0;
    const auto integrate = [&](double a, double b) {
        double sum = 0;
        for (int i = 0; i <= steps; ++i) {
            const double weight = i == 0 || i == steps ? 1 : i % 2 ? 4 : 2;
            sum += weight * std::pow(std::max(std::cos(a + (b - a) * i / steps), 0.0), n - 1);
        }
        return sum * (b - a) / (3 * steps);
    };
    tail = integrate(from, to);
    whole = integrate(0, to);
    return std::min(1.0, tail / whole);
}

/// Welch's test: probability of a difference as large as this if both means are equal. Equal constants give 1, different ones 0.
inline double welch(const Mean& a, const Mean& b) {
    const double variance = a.variance + b.variance, difference = a.value - b.value;
    // Sums in float differ in the last bits even where nothing is random.
    if (std::abs(difference) < 1e-5 * (std::abs(a.value) + std::abs(b.value)) + 1e-12) return 1;
    if (variance <= 0) return 0;
    const double freedom = variance * variance / (a.variance * a.variance / (a.count - 1) + b.variance * b.variance / (b.count - 1));
    return studentTail(difference / std::sqrt(variance), freedom);
}

struct Comparison {
    double energyP = 1;      ///< of the mean over all pixels
    double worstP = 1;       ///< of the block and channel that differ most, times their number (Bonferroni)
    double energyRatio = 1;  ///< a / b
    double halfWidth = 0;    ///< of the 95 % interval of energyRatio: the power, a bias of twice this is seen nearly always
    double blockWidth = 0;   ///< median over blocks of the same
    std::string text;

    /// Nothing is rejected at a family-wise 1e-3.
    bool equal() const { return energyP > 1e-3 && worstP > 1e-3; }
};

/// Value of block (bx, by) and channel of one frame.
inline double blockMean(const ImageData& image, int bx, int by, int block, int channel) {
    double sum = 0;
    int count = 0;
    for (int y = by * block; y < std::min(image.height, (by + 1) * block); ++y)
        for (int x = bx * block; x < std::min(image.width, (bx + 1) * block); ++x, ++count) sum += image.at(x, y, channel);
    return sum / count;
}

/// Frames of one size; blocks of `block` x `block` pixels, three channels. `fault` is a factor on b: a planted bias to test the test with.
inline Comparison compareFrames(const std::vector<ImageData>& a, const std::vector<ImageData>& b, int block = 16, double fault = 1) {
    Comparison result;
    const int columns = (a.at(0).width + block - 1) / block, rows = (a.at(0).height + block - 1) / block;
    std::vector<double> energyA(a.size()), energyB(b.size()), widths;
    std::string worst;
    for (int by = 0; by < rows; ++by) {
        for (int bx = 0; bx < columns; ++bx) {
            for (int c = 0; c < 3; ++c) {
                const auto samples = [&](const std::vector<ImageData>& frames, double factor, std::vector<double>& energy) {
                    std::vector<double> values;
                    for (std::size_t i = 0; i < frames.size(); ++i) {
                        values.push_back(factor * blockMean(frames[i], bx, by, block, c));
                        energy[i] += values.back() / (columns * rows * 3);
                    }
                    return lodestir::test::meanOf(values);
                };
                const Mean ma = samples(a, 1, energyA), mb = samples(b, fault, energyB);
                const double p = std::min(1.0, welch(ma, mb) * columns * rows * 3);
                if (mb.value > 0) widths.push_back(1.96 * std::sqrt(ma.variance + mb.variance) / mb.value);
                if (p >= result.worstP) continue;
                result.worstP = p;
                worst = "block (" + std::to_string(bx) + ", " + std::to_string(by) + ") channel " + std::to_string(c) + ": " +
                        std::to_string(ma.value) + " +- " + std::to_string(std::sqrt(ma.variance)) + " against " +
                        std::to_string(mb.value) + " +- " + std::to_string(std::sqrt(mb.variance));
            }
        }
    }
    const Mean ea = lodestir::test::meanOf(energyA), eb = lodestir::test::meanOf(energyB);
    result.energyP = welch(ea, eb);
    result.energyRatio = ea.value / eb.value;
    result.halfWidth = 1.96 * std::sqrt(ea.variance + eb.variance) / eb.value;
    if (!widths.empty()) {
        std::ranges::nth_element(widths, widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2));
        result.blockWidth = widths[widths.size() / 2];
    }
    result.text = "energy ratio " + std::to_string(result.energyRatio) + " +- " + std::to_string(result.halfWidth) + " (p " +
                  std::to_string(result.energyP) + "), blocks +- " + std::to_string(result.blockWidth) + ", worst p " +
                  std::to_string(result.worstP) + (worst.empty() ? "" : " at " + worst);
    return result;
}

}  // namespace lodestir::test
