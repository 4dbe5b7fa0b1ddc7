// SPDX-License-Identifier: MIT
// SSIM and MS-SSIM against values computed by hand and by a second, plainer way.
#include <framework/core/error.h>
#include <framework/image/aces.h>
#include <framework/image/metrics.h>
#include <framework/image/srgb.h>
#include <framework/image/ssim.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lodestir {
namespace {

ImageData noisy(unsigned seed, int width, int height, int channels) {
    ImageData result = makeImage(width, height, channels);
    std::mt19937 generator(seed);
    for (float& v : result.values) v = float(generator() % 4096) / 4096;
    return result;
}

/// `share` of another picture mixed in.
ImageData mixed(const ImageData& one, const ImageData& other, float share) {
    ImageData result = one;
    for (std::size_t i = 0; i < one.values.size(); ++i) result.values[i] += share * (other.values[i] - one.values[i]);
    return result;
}

Luma luma(int width, int height, const std::vector<double>& values) {
    Luma result(makeImage(width, height, 1), 1);
    result.values = values;
    return result;
}

double displayed(double radiance) { return static_cast<double>(encodeSrgb(static_cast<float>(toneMapAces(radiance)))); }

struct Terms {
    double brightness, structure;
};

/// The definition at the pixel (px, py), with the window as a whole.
Terms termsAt(const Luma& x, const Luma& r, int px, int py) {
    double weights = 0, mx = 0, mr = 0, xx = 0, rr = 0, xr = 0;
    const auto eachPixel = [&](const auto& body) {
        for (int v = -5; v <= 5; ++v)
            for (int u = -5; u <= 5; ++u) {
                const auto i = std::size_t(py + v) * std::size_t(x.width) + std::size_t(px + u);
                body(std::exp(-(u * u + v * v) / 4.5), x.values[i], r.values[i]);
            }
    };
    eachPixel([&](double w, double a, double b) { weights += w, mx += w * a, mr += w * b; });
    mx /= weights, mr /= weights;
    eachPixel(
        [&](double w, double a, double b) { xx += w * (a - mx) * (a - mx), rr += w * (b - mr) * (b - mr), xr += w * (a - mx) * (b - mr); });
    return {(2 * mx * mr + 1e-4) / (mx * mx + mr * mr + 1e-4), (2 * xr / weights + 9e-4) / ((xx + rr) / weights + 9e-4)};
}

/// Means over the interior of structure alone, and of the product.
Terms meansOf(const Luma& x, const Luma& r) {
    double structure = 0, both = 0, count = 0;
    for (int py = 5; py < x.height - 5; ++py)
        for (int px = 5; px < x.width - 5; ++px) {
            const Terms t = termsAt(x, r, px, py);
            structure += t.structure, both += t.brightness * t.structure, ++count;
        }
    return {both / count, structure / count};
}

TEST(Ssim, UniformImagesDifferInBrightnessAlone) {
    const double a = displayed(0.2), b = displayed(0.4), expected = (2 * a * b + 1e-4) / (a * a + b * b + 1e-4);
    const auto gray = [](float value, int side) {
        ImageData image = makeImage(side, side, 3);
        std::ranges::fill(image.values, value);
        return image;
    };
    const MetricOptions asIs{.exposure = 1.0};
    EXPECT_NEAR(evaluate("ssim", gray(0.2f, 32), gray(0.4f, 32), asIs), expected, 1e-6);
    EXPECT_NEAR(evaluate("ms_ssim", gray(0.2f, 176), gray(0.4f, 176), asIs), std::pow(expected, 0.1333), 1e-6);
    EXPECT_NEAR(evaluate("ms_ssim", gray(0.2f, 175), gray(0.4f, 175), asIs), std::pow(expected, 0.2363 * 1.0001 / 0.8668), 1e-6);
    EXPECT_NEAR(evaluate("ms_ssim", gray(0.2f, 11), gray(0.4f, 11), asIs), std::pow(expected, 1.0001), 1e-6);
    // Scaled so that the median luminance of the reference is 0.18; ACES makes 0.1401 of that, sRGB 0.4102.
    EXPECT_NEAR(displayed(0.18), 0.4102, 1e-4);
    EXPECT_NEAR(evaluate("ssim", gray(2, 32), gray(4, 32)), evaluate("ssim", gray(0.09f, 32), gray(0.18f, 32), asIs), 1e-6);
}

// What is dark in one picture is bright in the other: 1 minus twice the share that contrast has.
TEST(Ssim, OppositePatternsAreNegative) {
    std::vector<double> x, r;
    for (int i = 0; i < 31 * 31; ++i) x.push_back(i % 2 ? 0.75 : 0.25), r.push_back(i % 2 ? 0.25 : 0.75);
    const double variance = 0.0625, value = ssimMap(luma(31, 31, x), luma(31, 31, r))[15 * 31 + 15];
    EXPECT_NEAR(value, (-2 * variance + 9e-4) / (2 * variance + 9e-4), 1e-4);
    EXPECT_EQ(msSsim(luma(31, 31, x), luma(31, 31, r)), 0) << "a negative mean counts as 0";
}

TEST(Ssim, IsItsDefinition) {
    const ImageData r = noisy(1, 37, 90, 3), x = mixed(r, noisy(2, 37, 90, 3), 0.4f);
    const Luma lx(x, 0.7), lr(r, 0.7);
    const std::vector<double> map = ssimMap(lx, lr);
    for (int py = 0; py < 90; ++py)
        for (int px = 0; px < 37; ++px) {
            const bool isInside = px >= 5 && px < 32 && py >= 5 && py < 85;
            const Terms t = isInside ? termsAt(lx, lr, px, py) : Terms{1, 1};
            ASSERT_NEAR(map[std::size_t(py * 37 + px)], t.brightness * t.structure, 1e-12) << px << " " << py;
        }
    const MetricOptions options{.exposure = 0.7};
    EXPECT_NEAR(evaluate("ssim", x, r, options), meansOf(lx, lr).brightness, 1e-12) << "the border is left out";
    const ImageData errors = errorMap("ssim", x, r, options);
    EXPECT_FLOAT_EQ(errors.at(20, 40, 0), static_cast<float>(1 - map[40 * 37 + 20]));
    EXPECT_EQ(errors.at(4, 40, 0), 0);
    EXPECT_NEAR(lx.values[5],
                0.2126 * displayed(0.7 * double(x.at(5, 0, 0))) + 0.7152 * displayed(0.7 * double(x.at(5, 0, 1))) +
                    0.0722 * displayed(0.7 * double(x.at(5, 0, 2))),
                1e-6);
}

TEST(Ssim, ScalesAreMultiplied) {
    const ImageData r = noisy(3, 181, 177, 1), x = mixed(r, noisy(4, 181, 177, 1), 0.3f);
    Luma lx(x, 1), lr(r, 1);
    const auto half = [](const Luma& from) {
        std::vector<double> values;
        for (int py = 0; py + 1 < from.height; py += 2)
            for (int px = 0; px + 1 < from.width; px += 2) {
                double sum = 0;
                for (int k = 0; k < 4; ++k) sum += from.values[std::size_t((py + k / 2) * from.width + px + k % 2)];
                values.push_back(sum / 4);
            }
        return luma(from.width / 2, from.height / 2, values);
    };
    const double powers[] = {0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
    const double value = msSsim(lx, lr);
    double expected = 1;
    for (int scale = 0; scale < 5; ++scale) {
        if (scale > 0) lx = half(lx), lr = half(lr);
        const Terms means = meansOf(lx, lr);
        expected *= std::pow(scale == 4 ? means.brightness : means.structure, powers[scale]);
    }
    EXPECT_NEAR(value, expected, 1e-12);
    EXPECT_LT(value, 1);
}

TEST(Ssim, EqualImagesAreAtOne) {
    const ImageData r = noisy(5, 190, 180, 3), other = noisy(6, 190, 180, 3);
    EXPECT_EQ(evaluate("ssim", r, r), 1);
    EXPECT_EQ(evaluate("ms_ssim", r, r), 1);
    const MetricOptions asIs{.exposure = 1.0};
    for (const char* name : {"ssim", "ms_ssim"}) {
        EXPECT_NEAR(evaluate(name, r, other, asIs), evaluate(name, other, r, asIs), 1e-12) << name << " treats both images alike";
        double last = 1;
        for (float share : {0.05f, 0.1f, 0.2f, 0.4f, 0.8f}) {
            const double value = evaluate(name, mixed(r, other, share), r, asIs);
            EXPECT_LT(value, last - 0.001) << name << " falls as the pictures part: " << share;
            last = value;
        }
    }
}

TEST(Ssim, OnlyTheMaskCounts) {
    const ImageData r = noisy(7, 200, 190, 1);
    ImageData x = r;
    for (int y = 0; y < 190; ++y)
        for (int column = 96; column < 200; ++column) x.at(column, y, 0) = 0.5f;
    const auto columns = [&](int first, int last) {
        MetricOptions options{.mask = std::vector<bool>(r.pixelCount())};
        for (std::size_t i = 0; i < r.pixelCount(); ++i)
            options.mask[i] = static_cast<int>(i % 200) >= first && static_cast<int>(i % 200) < last;
        return options;
    };
    for (const char* name : {"ssim", "ms_ssim"}) {
        const double all = evaluate(name, x, r);
        EXPECT_NEAR(evaluate(name, x, r, columns(0, 200)), all, 1e-12) << name;
        EXPECT_GT(evaluate(name, x, r, columns(0, 96)), all) << name;
        EXPECT_LT(evaluate(name, x, r, columns(96, 200)), all) << name;
    }
    EXPECT_EQ(evaluate("ssim", x, r, columns(0, 91)), 1) << "no window there reaches what differs";
    EXPECT_TRUE(std::isnan(evaluate("ssim", x, r, columns(0, 5)))) << "no window there";
    EXPECT_TRUE(std::isnan(evaluate("ms_ssim", x, r, columns(0, 60)))) << "no window there on the smallest scale";
}

// `lodestir compare` evaluates every metric, whatever the size.
TEST(Ssim, SmallAndBrokenImagesAreNaN) {
    for (const auto& [width, height] : {std::pair{10, 40}, {40, 10}, {1, 1}, {300, 2}}) {
        const ImageData r = noisy(8, width, height, 3), x = noisy(9, width, height, 3);
        EXPECT_TRUE(std::isnan(evaluate("ssim", x, r))) << width;
        EXPECT_TRUE(std::isnan(evaluate("ms_ssim", x, r))) << width;
        EXPECT_EQ(errorMap("ssim", x, r).values, std::vector<float>(r.pixelCount())) << "no errors known";
    }
    const ImageData r = noisy(8, 40, 40, 3);
    for (const float broken : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
        ImageData x = r;
        x.at(20, 20, 0) = broken;
        EXPECT_TRUE(std::isnan(evaluate("ssim", x, r)));
        EXPECT_TRUE(std::isnan(evaluate("ms_ssim", x, r)));
    }
    EXPECT_THROW(errorMap("ms_ssim", r, r), Error);
}

}  // namespace
}  // namespace lodestir
