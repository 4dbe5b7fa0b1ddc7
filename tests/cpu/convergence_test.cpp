// SPDX-License-Identifier: MIT
// How means over runs converge, on images whose noise and bias are known.
#include <framework/study/ensemble/convergence.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lodestir {
namespace {

constexpr int width = 40, height = 30, chunkSize = 16;
constexpr double epsilon = 0.01;  // of relmse, at exposure 1: the median of the truth below is 0.18

/// From 0.08 to 0.28, grey.
double truth(std::size_t pixel) { return 0.08 + 0.2 * double(pixel) / (width * height - 1); }

/// Chunks of runs that are `scale` times the truth but for noise of a tenth of it.
std::vector<EnsembleImage> chunksOf(int count, double scale, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, 0.1);
    std::vector<EnsembleImage> chunks;
    for (int chunk = 0; chunk < count; ++chunk) {
        EnsembleImage image{.image = makeImage(width, height, 4), .runs = chunkSize};
        for (std::size_t p = 0; p < image.image.pixelCount(); ++p) {
            double sum = 0, squares = 0;
            for (int run = 0; run < chunkSize; ++run) {
                const double value = truth(p) * (scale + noise(random));
                sum += value / chunkSize;
                squares += value * value / chunkSize;
            }
            for (int c = 0; c < 3; ++c) image.image.values[4 * p + std::size_t(c)] = float(sum);
            image.image.values[4 * p + 3] = float(squares);
        }
        chunks.push_back(std::move(image));
    }
    return chunks;
}

/// The mean over pixels of (factor r)^2 / (r^2 + epsilon).
double relative(double factor) {
    double sum = 0;
    for (std::size_t p = 0; p < width * height; ++p) sum += std::pow(factor * truth(p), 2) / (truth(p) * truth(p) + epsilon);
    return sum / (width * height);
}

// If this fails, a report tells noise for bias, or a technique that is biased for one that converges.
TEST(Convergence, TellsBiasFromNoise) {
    const EnsembleImage reference = joinImages(chunksOf(16, 1, 1));
    const double noise = relative(0.1);
    const Convergence right = convergenceOf(chunksOf(16, 1, 2), reference), dark = convergenceOf(chunksOf(16, 0.97, 3), reference);
    for (const Convergence& c : {right, dark}) EXPECT_NEAR(c.noise, noise, 0.02 * noise);
    // The mean over 256 runs differs by noise / 256, which 1200 pixels tell to 4 %: that much is bias known to.
    const double uncertain = 4 * 0.06 * noise / 256;
    EXPECT_NEAR(right.bias, 0, uncertain);
    EXPECT_NEAR(dark.bias, relative(0.03), 0.05 * relative(0.03));
    EXPECT_GT(right.biasDeviation, 0);
    EXPECT_LT(std::abs(right.bias), 4 * right.biasDeviation);
    EXPECT_LT(right.biasDeviation, uncertain);
    EXPECT_NEAR(right.difference, right.differenceOfNoise, 0.1 * right.differenceOfNoise);
    EXPECT_GT(dark.difference, 2 * dark.differenceOfNoise);
}

TEST(Convergence, ErrorsOfMeansFallAsOneOverRuns) {
    const EnsembleImage reference = joinImages(chunksOf(64, 1, 4));
    const Convergence c = convergenceOf(chunksOf(5, 1, 5), reference);
    ASSERT_EQ(c.points.size(), 5u);  // 1 run; 1, 2, 4 and 5 chunks
    const double runs[] = {1, 16, 32, 64, 80};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(c.points[i].runs, runs[i]);
        EXPECT_NEAR(c.points[i].error, c.noise / runs[i], 0.25 * c.noise / runs[i]) << "of " << runs[i] << " runs";
    }
    EXPECT_TRUE(std::isnan(convergenceOf(chunksOf(3, 1, 6), reference).biasDeviation)) << "three chunks tell nothing of their spread";
}

}  // namespace
}  // namespace lodestir
