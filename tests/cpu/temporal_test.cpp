// SPDX-License-Identifier: MIT
// Flicker and tFLIP of sequences whose errors are known: still, offset, white noise, and errors that move with the content.
#include "../temporary_folder.h"

#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/image/sequence.h>
#include <framework/image/temporal.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace lodestir {
namespace {

const MetricOptions asIs{.exposure = 1.0, .flip = {.exposures = FlipExposures{0, 1, 2}}};

/// Grey light whose brightness as the metrics take it, log2(1 + Y), is `value`.
float light(double value) { return static_cast<float>(std::exp2(value) - 1); }

ImageData image(int width, int height, const std::function<double(int x, int y)>& value) {
    ImageData result = makeImage(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float grey = light(value(x, y));  // once: it may be random
            for (int c = 0; c < 3; ++c) result.at(x, y, c) = grey;
        }
    return result;
}

double pattern(int x, int y) { return 1 + 0.4 * std::sin(0.7 * x) * std::cos(0.3 * y); }

/// Mean over the steps of a sequence.
double measure(const char* metric, const std::vector<ImageData>& test, const std::vector<ImageData>& reference,
               const ImageData* motion = nullptr) {
    double sum = 0;
    for (std::size_t t = 1; t < test.size(); ++t)
        sum += evaluateStep(metric, {test[t], test[t - 1], reference[t], reference[t - 1], motion}, asIs);
    return sum / double(test.size() - 1);
}

TEST(Temporal, WhatIsStillHasNone) {
    const std::vector<ImageData> still(3, image(40, 30, pattern));
    for (const std::string& name : temporalMetricNames()) {
        EXPECT_EQ(measure(name.c_str(), still, still), 0) << name;
        EXPECT_GT(temporalMetricAbout(name).size(), 10u);
        EXPECT_TRUE(isTemporal(name));
    }
    EXPECT_FALSE(isTemporal("flip"));
}

// If this fails, a picture that is wrong but steady is said to flicker.
TEST(Temporal, AConstantOffsetIsAllCorrelated) {
    const std::vector<ImageData> reference(4, image(40, 30, pattern)),
        test(4, image(40, 30, [](int x, int y) { return pattern(x, y) + 0.25; }));
    EXPECT_NEAR(measure("flicker_correlated", test, reference), 0.0625, 1e-6);
    EXPECT_NEAR(measure("flicker_uncorrelated", test, reference), 0, 1e-12);
    EXPECT_NEAR(measure("tflip", test, reference), 0, 1e-12);
}

TEST(Temporal, WhiteNoiseHasItsVarianceAllUncorrelated) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal(0, 0.1);
    const std::vector<ImageData> reference(9, image(80, 60, pattern));
    std::vector<ImageData> test, offset;
    for (std::size_t t = 0; t < reference.size(); ++t) {
        test.push_back(image(80, 60, [&](int x, int y) { return pattern(x, y) + normal(random); }));
        offset.push_back(image(80, 60, [&](int x, int y) { return pattern(x, y) + 0.3 + normal(random); }));
    }
    // 38400 values: the variance is known to 0.8 %, the product of neighbours to 0.5 % of it; four sigmas of each.
    EXPECT_NEAR(measure("flicker_uncorrelated", test, reference), 0.01, 0.01 * 0.035);
    EXPECT_NEAR(measure("flicker_correlated", test, reference), 0, 0.01 * 0.022);
    EXPECT_NEAR(measure("flicker_uncorrelated", offset, reference), 0.01, 0.01 * 0.035);
    EXPECT_NEAR(measure("flicker_correlated", offset, reference), 0.09, 0.09 * 0.02);
    EXPECT_GT(measure("tflip", test, reference), 0.01);
}

// First-order autoregressive noise with correlation a: lag one has a times the variance.
TEST(Temporal, BoilingIsSplitByItsCorrelation) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, 1);
    constexpr double a = 0.8, sigma = 0.1;
    const int width = 80, height = 60;
    std::vector<double> error(std::size_t(width * height));
    for (double& e : error) e = sigma * normal(random);
    std::vector<ImageData> test, reference;
    for (int t = 0; t < 9; ++t) {
        test.push_back(image(width, height, [&](int x, int y) { return pattern(x, y) + error[std::size_t(y * width + x)]; }));
        reference.push_back(image(width, height, pattern));
        for (double& e : error) e = a * e + sigma * std::sqrt(1 - a * a) * normal(random);
    }
    EXPECT_NEAR(measure("flicker_correlated", test, reference), a * sigma * sigma, 0.06 * sigma * sigma);
    EXPECT_NEAR(measure("flicker_uncorrelated", test, reference), (1 - a) * sigma * sigma, 0.015 * sigma * sigma);
}

// If this fails, noise that sticks to a moving surface, which looks like dirt on it, is taken for flicker.
TEST(Temporal, ErrorsThatMoveWithTheContentAreCorrelatedAlongTheMotion) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal(0, 0.1);
    const int width = 96, height = 40, speed = 2, frames = 6;
    std::vector<double> stuck(std::size_t((width + speed * frames) * height));
    for (double& e : stuck) e = normal(random);
    const int row = width + speed * frames;
    std::vector<ImageData> test, reference;
    for (int t = 0; t < frames; ++t) {  // the content moves to the left
        reference.push_back(image(width, height, [&](int x, int y) { return pattern(x + speed * t, y); }));
        test.push_back(
            image(width, height, [&](int x, int y) { return pattern(x + speed * t, y) + stuck[std::size_t(y * row + x + speed * t)]; }));
    }
    ImageData motion = makeImage(width, height, 2);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) motion.at(x, y, 0) = float(speed);
    EXPECT_NEAR(measure("flicker_uncorrelated", test, reference, &motion), 0, 1e-12);
    EXPECT_NEAR(measure("flicker_correlated", test, reference, &motion), 0.01, 0.001);
    EXPECT_NEAR(measure("flicker_uncorrelated", test, reference), 0.01, 0.001) << "in place, it is new noise each frame";
    EXPECT_NEAR(measure("flicker_correlated", test, reference), 0, 0.001);
    // The reference moves as well, and a change that both have is none.
    EXPECT_EQ(measure("tflip", reference, reference), 0);
    EXPECT_GT(measure("tflip", test, reference), 0.01);
    EXPECT_GT(measure("tflip", std::vector<ImageData>(std::size_t(frames), reference[0]), reference), 0.01)
        << "a picture that hangs lacks changes";
}

// If this fails, what a viewer sees of a switch is mixed up with how wrong the picture is.
TEST(Temporal, StepFlipIsTheChangeAViewerSeesWhateverTheReference) {
    const ImageData still = image(40, 30, pattern), other = image(40, 30, [](int x, int y) { return pattern(x, y) + 0.3; });
    EXPECT_EQ(evaluateStep("step_flip", {other, other, still, still}, asIs), 0) << "wrong but steady";
    const double seen = evaluate("flip", other, still, asIs);
    EXPECT_GT(seen, 0.02);
    EXPECT_DOUBLE_EQ(evaluateStep("step_flip", {other, still, still, still}, asIs), seen);
    EXPECT_DOUBLE_EQ(evaluateStep("step_flip", {other, still, other, still}, asIs), seen) << "a change that the reference has is seen as well";
    EXPECT_NEAR(evaluateStep("tflip", {other, still, other, still}, asIs), 0, 1e-12) << "other than by tflip";
    // A mask counts where the change is, and nothing where it isn't.
    const ImageData half = image(40, 30, [](int x, int y) { return pattern(x, y) + (x < 20 ? 0.3 : 0); });
    MetricOptions left = asIs, right = asIs;
    for (int i = 0; i < 40 * 30; ++i) left.mask.push_back(i % 40 < 10), right.mask.push_back(i % 40 >= 35);
    EXPECT_GT(evaluateStep("step_flip", {half, still, still, still}, left), 0.02);
    EXPECT_NEAR(evaluateStep("step_flip", {half, still, still, still}, right), 0, 1e-3);
}

TEST(Temporal, OnlyTheMaskAndWhatWasInTheFrameCount) {
    const ImageData reference = makeImage(3, 1, 1);
    const ImageData now{3, 1, 1, {light(1), light(2), light(4)}}, before{3, 1, 1, {light(1), light(1), light(0)}};
    const Step step{now, before, reference, reference};
    EXPECT_NEAR(evaluateStep("flicker_uncorrelated", step, {.exposure = 1}), (0 + 1 + 16) / 2.0 / 3, 1e-6);
    EXPECT_NEAR(evaluateStep("flicker_correlated", step, {.exposure = 1}), (1 + 2 + 0) / 3.0, 1e-6);
    EXPECT_NEAR(evaluateStep("flicker_uncorrelated", step, {.exposure = 1, .mask = {true, true, false}}), 0.25, 1e-6);
    const ImageData motion{3, 1, 2, {-1, 0, -1, 0, -1, 0}};  // all came from the left
    const Step moved{now, before, reference, reference, &motion};
    EXPECT_NEAR(evaluateStep("flicker_correlated", moved, {.exposure = 1}), (2 * 1 + 4 * 1) / 2.0, 1e-6) << "the first pixel was outside";
    const ImageData away{3, 1, 2, {9, 0, 9, 0, 9, std::nanf("")}};
    EXPECT_TRUE(std::isnan(evaluateStep("flicker_correlated", {now, before, reference, reference, &away}, {.exposure = 1})));
    ImageData broken = now;
    broken.values[0] = std::nanf("");
    for (const std::string& name : temporalMetricNames())
        EXPECT_TRUE(std::isnan(evaluateStep(name, {broken, before, reference, reference}, asIs))) << name;
}

TEST(Temporal, RefusesWhatCannotBeCompared) {
    const ImageData a = makeImage(3, 2, 3), b = makeImage(2, 3, 3), motion = makeImage(3, 2, 1), none;
    EXPECT_THROW(evaluateStep("tflip", {a, b, a, a}), Error);
    EXPECT_THROW(evaluateStep("tflip", {none, none, none, none}), Error);
    EXPECT_THROW(evaluateStep("tflip", {a, a, a, a, &motion}), Error);
    EXPECT_THROW(evaluateStep("tflip", {a, a, a, a}, {.mask = {true}}), Error);
    EXPECT_THROW(evaluateStep("flicker", {a, a, a, a}), Error);
}

TEST(Sequences, AreFoundByNumber) {
    const test::TemporaryFolder temporary;
    const Path& folder = temporary.path;
    for (const char* file : {"a.0.exr", "a.1.exr", "a.10.exr", "a.1.png", "a.x.exr", "a.-1.exr", "b.1.exr", "a..exr", "a.1b.exr"})
        writeFile(folder / file, std::string_view("x"));
    EXPECT_TRUE(isSequence(folder / "a.%d.exr"));
    EXPECT_FALSE(isSequence(folder / "a.0.exr"));
    EXPECT_EQ(sequenceFiles(folder / "a.%d.exr"),
              (std::map<int, Path>{{0, folder / "a.0.exr"}, {1, folder / "a.1.exr"}, {10, folder / "a.10.exr"}}));
    EXPECT_THROW(sequenceFiles(folder / "c.%d.exr"), Error);
    EXPECT_THROW(sequenceFiles(folder / "a.%d.%d"), Error);
    EXPECT_THROW(sequenceFiles("/no/such/folder/a.%d.exr"), Error);
    writeFile(folder / "a.01.exr", std::string_view("x"));
    EXPECT_THROW(sequenceFiles(folder / "a.%d.exr"), Error) << "1 and 01";
}

}  // namespace
}  // namespace lodestir
