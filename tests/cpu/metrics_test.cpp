// SPDX-License-Identifier: MIT
// Error metrics against values computed by hand.
#include <framework/core/error.h>
#include <framework/image/aces.h>
#include <framework/image/metrics.h>
#include <framework/image/srgb.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lodestir {
namespace {

const MetricOptions asIs{.exposure = 1.0};

ImageData gray(std::vector<float> values) { return {static_cast<int>(values.size()), 1, 1, std::move(values)}; }

TEST(Metrics, HandComputedOnGrey) {
    const ImageData x = gray({1, 2, 0, 0.5f}), r = gray({1, 1, 0.5f, 0});
    EXPECT_DOUBLE_EQ(evaluate("mse", x, r), (0 + 1 + 0.25 + 0.25) / 4);
    EXPECT_DOUBLE_EQ(evaluate("rmse", x, r), std::sqrt(0.375));
    EXPECT_DOUBLE_EQ(evaluate("mae", x, r), (0 + 1 + 0.5 + 0.5) / 4);
    EXPECT_DOUBLE_EQ(evaluate("relmse", x, r, asIs), (1 / 1.01 + 0.25 / 0.26 + 0.25 / 0.01) / 4);
    EXPECT_DOUBLE_EQ(evaluate("mape", x, r, asIs), 100 * (1 / 1.01 + 0.5 / 0.51 + 0.5 / 0.01) / 4);
    EXPECT_DOUBLE_EQ(evaluate("smape", x, r, asIs), (1 / 3.01 + 0.5 / 0.51 + 0.5 / 0.51) / 4);
    EXPECT_DOUBLE_EQ(evaluate("bias", x, r), 3.5 / 2.5 - 1);
    const double a = static_cast<double>(encodeSrgb(0.5f));  // 2 is shown as 1
    EXPECT_NEAR(evaluate("psnr", x, r), -10 * std::log10(2 * a * a / 4), 1e-12);
}

// If this fails, RelMSE divides each channel by itself, or by a luminance, and no longer is what its definition says.
TEST(Metrics, RelMseDividesByTheMeanOfThePixel) {
    const ImageData x{1, 1, 3, {1, 2, 3}}, r{1, 1, 3, {1, 0, 0.5f}};
    EXPECT_DOUBLE_EQ(evaluate("relmse", x, r, asIs), (0 + 4 + 6.25) / 3 / (0.5 * 0.5 + 0.01));
    EXPECT_DOUBLE_EQ(evaluate("mse", x, r), 10.25 / 3);
    EXPECT_DOUBLE_EQ(evaluate("mae", x, r), 4.5 / 3);
}

TEST(Metrics, ExposureBringsTheMedianTo018) {
    EXPECT_DOUBLE_EQ(exposureOf(gray({0, 0, 0, 1, 2, 4})), 0.18 / 2);  // pixels of 0 don't count; upper median of the others
    EXPECT_FLOAT_EQ(static_cast<float>(exposureOf({1, 1, 3, {1, 2, 3}})), static_cast<float>(0.18 / (0.2126 + 2 * 0.7152 + 3 * 0.0722)));
    EXPECT_DOUBLE_EQ(exposureOf(gray({0, 0, -1})), 1);
    EXPECT_DOUBLE_EQ(exposureOf(gray({std::nanf(""), std::numeric_limits<float>::infinity(), 2})), 0.09);
    const ImageData x = gray({1, 2, 3}), r = gray({1, 1, 2});
    EXPECT_DOUBLE_EQ(evaluate("relmse", x, r), evaluate("relmse", x, r, {.exposure = 0.18}));
    // Brightness alone must not change a relative error.
    const ImageData brightX = gray({64, 128, 192}), brightR = gray({64, 64, 128});
    for (const char* name : {"relmse", "relmse_trimmed", "mape", "smape", "bias"}) {
        EXPECT_NEAR(evaluate(name, x, r), evaluate(name, brightX, brightR), 1e-12) << name;
    }
    EXPECT_DOUBLE_EQ(evaluate("relmse", gray({1.1f}), gray({1})),
                     std::pow(0.18 * (static_cast<double>(1.1f) - 1), 2) / (0.18 * 0.18 + 0.01));
}

TEST(Metrics, TrimmingDropsOnePixelInAThousand) {
    ImageData x = gray(std::vector<float>(2500, 2)), r = gray(std::vector<float>(2500, 1));
    const double usual = evaluate("relmse", x, r, asIs);
    x.values[7] = 1e6f;
    x.values[99] = 1e6f;
    EXPECT_GT(evaluate("relmse", x, r, asIs), 1e6);
    EXPECT_NEAR(evaluate("relmse_trimmed", x, r, asIs), usual, 1e-12) << "2500 pixels have two to spare";
    x.values[100] = 1e6f;
    EXPECT_GT(evaluate("relmse_trimmed", x, r, asIs), 1e6);
    x.values[100] = std::nanf("");
    EXPECT_TRUE(std::isnan(evaluate("relmse_trimmed", x, r, asIs))) << "a broken pixel is no outlier";
}

TEST(Metrics, EqualImagesAreAtTheBestValue) {
    ImageData r = makeImage(12, 11, 3);
    for (std::size_t i = 0; i < r.values.size(); ++i) r.values[i] = static_cast<float>(i % 4);
    for (const std::string& name : metricNames()) {
        const double best = name == "psnr" ? std::numeric_limits<double>::infinity() : name.ends_with("ssim") ? 1 : 0;
        EXPECT_EQ(evaluate(name, r, r), best) << name;
        EXPECT_GT(metricAbout(name).size(), 10u);
    }
}

TEST(Metrics, BrokenPixelsShow) {
    const ImageData r = gray({1, 1}), x = gray({1, std::nanf("")});
    for (const std::string& name : metricNames()) EXPECT_TRUE(std::isnan(evaluate(name, x, r))) << name;
}

TEST(Metrics, MapsHoldWhatIsAveraged) {
    const ImageData x{2, 1, 3, {1, 2, 3, 4, 4, 4}}, r{2, 1, 3, {1, 0, 0.5f, 4, 4, 4}};
    const ImageData map = errorMap("mse", x, r);
    ASSERT_EQ(map.channels, 1);
    ASSERT_EQ(map.width, 2);
    EXPECT_FLOAT_EQ(map.at(0, 0, 0), 10.25f / 3);
    EXPECT_EQ(map.at(1, 0, 0), 0);
    EXPECT_EQ(errorMap("bias", gray({0, 3}), gray({1, 1})).values, (std::vector<float>{-1, 2}));
}

TEST(Metrics, RefuseWhatCannotBeCompared) {
    const auto refusal = [](const char* name, const ImageData& x, const ImageData& r) {
        try {
            evaluate(name, x, r);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(refusal("mse", makeImage(4, 3, 3), makeImage(5, 3, 1)),
              "the images cannot be compared: the test has 4 x 3 pixels of 3 channels, the reference 5 x 3 pixels of 1 channels");
    EXPECT_EQ(refusal("mse", makeImage(0, 0, 3), makeImage(0, 0, 3)), "the images cannot be compared: they have no pixels");
    EXPECT_EQ(refusal("relsme", makeImage(1, 1, 1), makeImage(1, 1, 1)), "unknown metric \"relsme\"; did you mean \"relmse\"?");
}

/// A vertical edge in the middle of 8 x 8 pixels, `low` to the left and `high` to the right.
ImageData edge(float low, float high) {
    ImageData image = makeImage(8, 8, 1);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) image.at(x, y, 0) = x < 4 ? low : high;
    return image;
}

// If this fails, GMSD is not that of its paper: another filter, another constant, or no means of 2 x 2 pixels.
TEST(Metrics, GradientDeviationOfAnEdgeByHand) {
    const ImageData r = edge(0.1f, 0.8f), flat = edge(0.4f, 0.4f);
    // On 4 x 4 means the columns beside the edge have the gradient h, the outer ones none. Prewitt: three rows of differences, each / 3.
    const auto luma = [](float value) { return double(encodeSrgb(float(toneMapAces(double(value))))); };
    const double h = luma(0.8f) - luma(0.1f), similar = 0.0026 / (h * h + 0.0026);
    EXPECT_NEAR(evaluate("gmsd", flat, r, asIs), (1 - similar) / 2, 1e-6) << "half the pixels at 1, half at `similar`";
    const ImageData map = errorMap("gmsd", flat, r, asIs);
    EXPECT_NEAR(double(map.at(0, 0, 0)), 0, 1e-6);
    EXPECT_NEAR(double(map.at(3, 7, 0)), 1 - similar, 1e-6);
    const double weak = luma(0.5f) - luma(0.1f), both = (2 * weak * h + 0.0026) / (weak * weak + h * h + 0.0026);
    EXPECT_NEAR(evaluate("gmsd", edge(0.1f, 0.5f), r, asIs), (1 - both) / 2, 1e-6);
    EXPECT_NEAR(evaluate("gmsd", edge(0.8f, 0.1f), r, asIs), 0, 1e-6) << "strength counts, not direction";
    EXPECT_NEAR(evaluate("gmsd", edge(0.3f, 0.3f), flat, asIs), 0, 1e-12) << "an offset has no gradient";
    ImageData odd = makeImage(5, 3, 3);
    odd.at(4, 2, 1) = std::nanf("");
    EXPECT_TRUE(std::isnan(evaluate("gmsd", odd, makeImage(5, 3, 3), asIs))) << "the last odd pixel counts";
}

TEST(Metrics, ManyAtOnceAreTheSameAsOneByOne) {
    ImageData x = makeImage(24, 20, 3), r = makeImage(24, 20, 3);
    for (std::size_t i = 0; i < x.values.size(); ++i) x.values[i] = float(i % 7) / 5, r.values[i] = float(i % 5) / 4 + 0.1f;
    const std::vector<std::string> names = metricNames();
    const auto all = evaluateAll(names, x, r);
    ASSERT_EQ(all.size(), names.size());
    for (const auto& [name, value] : all) EXPECT_EQ(value, evaluate(name, x, r)) << name;
    EXPECT_THROW(evaluateAll({"mse", "no such"}, x, r), Error);
}

TEST(Metrics, OnlyTheMaskCounts) {
    const ImageData x = gray({1, 2, 9}), r = gray({1, 1, 3});
    const MetricOptions left{.exposure = 1, .mask = {true, true, false}};
    EXPECT_DOUBLE_EQ(evaluate("mse", x, r, left), 0.5);
    EXPECT_DOUBLE_EQ(evaluate("bias", x, r, left), 0.5) << "the mean of the reference is taken in the mask, too";
    EXPECT_DOUBLE_EQ(evaluate("mse", x, r, {.mask = {true, true, true}}), evaluate("mse", x, r));
    EXPECT_THROW(evaluate("mse", x, r, {.mask = {true}}), Error);
    EXPECT_THROW(evaluate("mse", x, r, {.mask = {false, false, false}}), Error);
}

}  // namespace
}  // namespace lodestir
