// SPDX-License-Identifier: MIT
// FLIP against the values of its published program, for made images and, where the folder of test assets lies beside the project, for photographs.
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/image/flip.h>
#include <framework/image/image_file.h>
#include <framework/image/metrics.h>
#include <framework/image/srgb.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

namespace lodestir {
namespace {

using Rgb = std::array<float, 3>;
using Errors = std::vector<double>;

ImageData image(const std::function<Rgb(int x, int y)>& at, int width = 64, int height = 64) {
    ImageData result = makeImage(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) std::ranges::copy(at(x, y), result.values.data() + result.index(x, y, 0));
    return result;
}
ImageData uniform(Rgb color) {
    return image([&](int, int) { return color; });
}
ImageData gray(const std::function<float(int x, int y)>& at, int width = 64, int height = 64) {
    return image(
        [&](int x, int y) {
            const float v = at(x, y);
            return Rgb{v, v, v};
        },
        width, height);
}

double meanOf(const Errors& errors) { return std::accumulate(errors.begin(), errors.end(), 0.0) / double(errors.size()); }
/// The smallest error with more than `share` of the sum of all in it and those below.
double weightedQuantile(Errors errors, double share) {
    std::ranges::sort(errors);
    const double total = std::accumulate(errors.begin(), errors.end(), 0.0);
    double sum = 0;
    for (double error : errors) {
        sum += error;
        if (sum > share * total) return error;
    }
    return errors.back();
}

/// The published program filters in floats, whose rounding leaves about 1e-7 of a uniform picture's brightness as an edge; the root of that in
/// the exponent moves an error by up to 5e-5. It sums in floats, too, which moves the mean of a large picture by as much.
constexpr double tolerance = 6e-5;

void expectErrors(const Errors& errors, double mean, double min, double max, const std::string& what) {
    EXPECT_NEAR(meanOf(errors), mean, tolerance) << what;
    EXPECT_NEAR(std::ranges::min(errors), min, tolerance) << what;
    EXPECT_NEAR(std::ranges::max(errors), max, tolerance) << what;
}

// If these fail, what is called FLIP here is something else.
TEST(Flip, MadeImagesHaveThePublishedErrors) {
    const auto srgb = [](float encoded) {
        const float v = decodeSrgb(encoded);
        return uniform({v, v, v});
    };
    const ImageData black = uniform({0, 0, 0}), white = uniform({1, 1, 1}), red = uniform({1, 0, 0}), green = uniform({0, 1, 0}),
                    blue = uniform({0, 0, 1});
    const auto edgeAt = [](int edge) { return gray([=](int x, int) { return x >= edge ? 1.0f : 0.0f; }); };
    const ImageData dot = gray([](int x, int y) { return x == 32 && y == 32 ? 1.0f : 0.0f; });
    const ImageData checker = gray([](int x, int y) { return float((x + y) % 2); }), half = uniform({0.5f, 0.5f, 0.5f});
    expectErrors(flipLdr(srgb(0.5f), srgb(0.6f)), .285063, .285063, .285063, "greys");
    expectErrors(flipLdr(srgb(0.5f), srgb(0.51f)), .057496, .057496, .057496, "greys that hardly differ");
    expectErrors(flipLdr(black, white), .967388, .967388, .967388, "black and white");
    expectErrors(flipLdr(green, blue), 1, 1, 1, "green and blue");
    expectErrors(flipLdr(red, green), .986665, .986665, .986665, "red and green");
    expectErrors(flipLdr(edgeAt(32), edgeAt(33)), .051732, 0, .772917, "an edge moved by a pixel");
    expectErrors(flipLdr(black, dot), .003493, 0, .864906, "a dot");
    expectErrors(flipLdr(checker, half), .004204, .001040, .515740, "a checkerboard too fine to be seen");
}

TEST(Flip, MadeRadianceHasThePublishedErrors) {
    const auto ramp = [](int x) { return 0.01f * std::exp2(float(x) / 8); };
    const ImageData reference = gray([&](int x, int) { return ramp(x); });
    const FlipExposures exposures = flipExposures(reference);
    EXPECT_NEAR(exposures.start, -.1478, 5e-5);
    EXPECT_NEAR(exposures.stop, 3.7272, 5e-5);
    EXPECT_EQ(exposures.count, 4);
    expectErrors(flipHdr(gray([&](int x, int) { return 1.1f * ramp(x); }), reference), .121643, .053663, .140153, "a tenth brighter");
    expectErrors(flipHdr(image([&](int x, int) {
                             return Rgb{ramp(x) + 0.05f, ramp(x), ramp(x)};
                         }),
                         reference),
                 .305441, .020099, .804381, "redder");
}

ImageData noisy(unsigned seed, int width, int height, int channels, float top) {
    ImageData result = makeImage(width, height, channels);
    std::mt19937 generator(seed);
    for (float& v : result.values) v = top * float(generator() % 4096) / 4096;
    return result;
}

ImageData blurred(const ImageData& source, int radius) {
    ImageData result = source;
    for (int y = 0; y < source.height; ++y)
        for (int x = 0; x < source.width; ++x)
            for (int c = 0; c < source.channels; ++c) {
                float sum = 0;
                for (int i = -radius; i <= radius; ++i) sum += source.at(std::clamp(x + i, 0, source.width - 1), y, c);
                result.at(x, y, c) = sum / float(2 * radius + 1);
            }
    return result;
}

TEST(Flip, EqualImagesHaveNoErrorAtAll) {
    const ImageData x = noisy(1, 70, 150, 3, 8);  // more rows than are filtered at once
    for (const Errors& errors : {flipLdr(x, x), flipHdr(x, x)}) {
        ASSERT_EQ(errors.size(), x.pixelCount());
        EXPECT_EQ(std::ranges::max(errors), 0);
    }
}

// LDR-FLIP treats both images alike; HDR-FLIP has its exposures from one of them.
TEST(Flip, OnlyTheLdrVariantIsSymmetric) {
    const ImageData x = noisy(1, 40, 30, 3, 1), r = noisy(2, 40, 30, 3, 0.2f);
    EXPECT_EQ(flipLdr(x, r), flipLdr(r, x));
    EXPECT_GT(std::abs(meanOf(flipHdr(x, r)) - meanOf(flipHdr(r, x))), 1e-3);
    const FlipOptions fixed{.exposures = FlipExposures{-1, 2, 4}};
    EXPECT_EQ(flipHdr(x, r, fixed), flipHdr(r, x, fixed));
}

TEST(Flip, GrowsWithTheDifference) {
    const ImageData r = gray([](int x, int y) { return (x / 8 + y / 8) % 2 ? 0.8f : 0.1f; });
    double last = 0;
    for (int radius : {1, 2, 3, 5}) {
        const double error = meanOf(flipHdr(blurred(r, radius), r));
        EXPECT_GT(error, last + 0.01) << radius;
        last = error;
    }
    // A viewer who sits farther away sees less of it.
    EXPECT_LT(meanOf(flipLdr(blurred(r, 2), r, {.pixelsPerDegree = 134})), 0.8 * meanOf(flipLdr(blurred(r, 2), r)));
}

TEST(Flip, StripsDontShow) {
    // The error depends on a pixel's surroundings only: rows 40 to 99 of a tall image are those of that part with a border as wide as the filters.
    const ImageData x = noisy(3, 24, 180, 3, 1), r = noisy(4, 24, 180, 3, 1);
    const auto rows = [](const ImageData& whole) {
        ImageData part = makeImage(24, 80, 3);
        std::copy_n(whole.values.data() + whole.index(0, 30, 0), part.values.size(), part.values.data());
        return part;
    };
    const Errors whole = flipLdr(x, r), part = flipLdr(rows(x), rows(r));
    for (std::size_t i = 0; i < 24 * 60; ++i) ASSERT_EQ(whole[24 * 40 + i], part[24 * 10 + i]) << i;
}

// Half of the picture black: the published program has no end there.
TEST(Flip, BlackReferencesHaveAnEnd) {
    const ImageData mostlyBlack = gray([](int x, int) { return x < 40 ? 0 : x < 52 ? 0.25f : 4.0f; });
    const FlipExposures exposures = flipExposures(mostlyBlack);
    EXPECT_NEAR(exposures.stop - exposures.start, 0, 1e-6) << "of the pixels above 0, the upper median is 4";
    EXPECT_EQ(exposures.count, 2);
    const FlipExposures wider = flipExposures(gray([](int x, int) { return x < 40 ? 0 : x < 56 ? 0.25f : 4.0f; }));
    EXPECT_NEAR(wider.stop - wider.start, 4, 1e-6);
    EXPECT_EQ(wider.count, 4);
    EXPECT_NEAR(wider.stops(3), wider.stop, 1e-12);

    const ImageData black = uniform({0, 0, 0}), x = uniform({0.5f, 0.5f, 0.5f});
    const FlipExposures none = flipExposures(black);
    EXPECT_EQ(none.count, 1);
    EXPECT_EQ(none.start, 0);
    EXPECT_EQ(meanOf(flipHdr(black, black)), 0);
    EXPECT_GT(meanOf(flipHdr(x, black)), 0.5);
}

TEST(Flip, ExposuresCanBeFixed) {
    const ImageData r = noisy(5, 32, 32, 3, 3), x = noisy(6, 32, 32, 3, 3);
    EXPECT_EQ(flipHdr(x, r), flipHdr(x, r, {.exposures = flipExposures(r)}));
    EXPECT_NEAR(evaluate("flip", x, r, {.flip = {.exposures = FlipExposures{0, 3, 2}}}),
                meanOf(flipHdr(x, r, {.exposures = FlipExposures{0, 3, 2}})), 1e-12);
    // One exposure is LDR-FLIP of the tone-mapped images.
    EXPECT_GT(meanOf(flipHdr(x, r)), meanOf(flipHdr(x, r, {.exposures = FlipExposures{flipExposures(r).start, 0, 1}})));
    EXPECT_THROW(flipHdr(x, r, {.exposures = FlipExposures{0, 1, 0}}), Error);
    EXPECT_THROW(flipHdr(x, r, {.exposures = FlipExposures{0, std::numeric_limits<double>::infinity(), 2}}), Error);
    EXPECT_THROW(flipLdr(x, r, {.pixelsPerDegree = 0}), Error);
    EXPECT_THROW(flipLdr(x, makeImage(31, 32, 3)), Error);
    EXPECT_THROW(flipLdr(makeImage(0, 3, 3), makeImage(0, 3, 3)), Error);
}

TEST(Flip, BrokenPixelsStayBroken) {
    ImageData x = noisy(7, 64, 40, 3, 1);
    const ImageData r = noisy(8, 64, 40, 3, 1);
    x.at(20, 20, 1) = std::nanf("");
    for (const Errors& errors : {flipLdr(x, r), flipHdr(x, r)}) {
        EXPECT_TRUE(std::isnan(errors[20 * 64 + 20]));
        EXPECT_TRUE(std::isnan(errors[10 * 64 + 30])) << "as far as the filters reach";
        EXPECT_FALSE(std::isnan(errors[20 * 64 + 31]));
    }
    EXPECT_TRUE(std::isnan(evaluate("flip", x, r)));
    ImageData bright = r;
    bright.at(3, 3, 0) = std::numeric_limits<float>::infinity();
    EXPECT_EQ(flipExposures(bright).count, flipExposures(r).count) << "an infinite pixel doesn't count";
}

TEST(Flip, AsMetrics) {
    const ImageData r = noisy(9, 32, 20, 3, 2), x = blurred(r, 2);
    EXPECT_NEAR(evaluate("flip", x, r), meanOf(flipHdr(x, r)), 1e-12);
    EXPECT_NEAR(evaluate("flip_ldr", x, r), meanOf(flipLdr(x, r)), 1e-12);
    const ImageData map = errorMap("flip", x, r);
    EXPECT_EQ(map.width, 32);
    EXPECT_FLOAT_EQ(map.at(7, 9, 0), static_cast<float>(flipHdr(x, r)[9 * 32 + 7]));
    MetricOptions onePixel{.mask = std::vector<bool>(r.pixelCount())};
    onePixel.mask[9 * 32 + 7] = true;
    EXPECT_NEAR(evaluate("flip", x, r, onePixel), flipHdr(x, r)[9 * 32 + 7], 1e-12);
    const auto equalChannels = [](const ImageData& one) {
        return gray([&](int px, int py) { return one.at(px, py, 0); }, one.width, one.height);
    };
    const ImageData g = noisy(10, 20, 20, 1, 1), h = noisy(11, 20, 20, 1, 1);
    EXPECT_EQ(flipLdr(g, h), flipLdr(equalChannels(g), equalChannels(h))) << "one channel is grey";
}

class FlipAssets : public testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(folder / "expected_ldr.csv"))
            GTEST_SKIP() << "the folder of test assets (../shared/assets/flip) is not here";
    }

    /// Every pair of the table, columns reference, test, mean, weighted median and quartiles, min, max; returns how many are here.
    int compareAll(const std::string& kind, const std::function<Errors(const ImageData&, const ImageData&)>& flip) {
        std::istringstream table(readText(folder / ("expected_" + kind + ".csv")));
        int compared = 0;
        std::string line;
        std::getline(table, line);
        while (std::getline(table, line)) {
            std::erase(line, '"');
            std::ranges::replace(line, ',', ' ');
            std::istringstream columns(line);
            std::string reference, test;
            double mean, median, lower, upper, min, max;
            columns >> reference >> test >> mean >> median >> lower >> upper >> min >> max;
            if (!std::filesystem::exists(folder / "pairs" / test)) continue;
            const ImageData x = readImage(folder / "pairs" / test), r = readImage(folder / "pairs" / reference);
            const Errors errors = flip(x, r);
            ++compared;
            EXPECT_NEAR(meanOf(errors), mean, tolerance) << test;
            EXPECT_NEAR(weightedQuantile(errors, 0.5), median, tolerance) << test;
            EXPECT_NEAR(weightedQuantile(errors, 0.25), lower, tolerance) << test;
            EXPECT_NEAR(weightedQuantile(errors, 0.75), upper, tolerance) << test;
            EXPECT_NEAR(std::ranges::min(errors), min, tolerance) << test;
            EXPECT_NEAR(std::ranges::max(errors), max, tolerance) << test;
            compareMap(errors, folder / "maps" / Path(test).replace_extension(".png"));
        }
        return compared;
    }

    const Path folder = Path(LODESTIR_SOURCE_DIR) / ".." / "shared" / "assets" / "flip";

private:
    /// The published program's own picture of the errors, with 8 bits.
    static void compareMap(const Errors& errors, const Path& file) {
        if (!std::filesystem::exists(file)) return;
        const ImageData map = readImage(file);
        ASSERT_EQ(map.pixelCount(), errors.size());
        double largest = 0;
        for (std::size_t i = 0; i < errors.size(); ++i) {
            const double shown = static_cast<double>(encodeSrgb(map.values[i * std::size_t(map.channels)]));
            largest = std::max(largest, std::abs(errors[i] - shown));
        }
        EXPECT_LT(largest, 1.01 / 255) << file;
    }
};

TEST_F(FlipAssets, PhotographsHaveThePublishedErrors) {
    EXPECT_GE(compareAll("ldr", [](const ImageData& x, const ImageData& r) { return flipLdr(x, r); }), 6);
}

TEST_F(FlipAssets, RadianceMapsHaveThePublishedErrors) {
    const FlipExposures exposures = flipExposures(readImage(folder / "pairs" / "hdr_ref.exr"));
    EXPECT_NEAR(exposures.start, .1971, 5e-5);
    EXPECT_NEAR(exposures.stop, 2.6403, 5e-5);
    EXPECT_EQ(exposures.count, 3);
    EXPECT_GE(compareAll("hdr", [](const ImageData& x, const ImageData& r) { return flipHdr(x, r); }), 4);
}

}  // namespace
}  // namespace lodestir
