// SPDX-License-Identifier: MIT
// Numbers of ports in words, and the ranges that false colours follow.
#include <framework/app/view/texel_values.h>

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace lodestir {
namespace {

TEST(TexelValues, NumbersAsPeopleReadThem) {
    EXPECT_EQ(numberText(std::bit_cast<std::uint32_t>(0.25f), NUMBER_FLOAT32), "0.25000");
    EXPECT_EQ(numberText(std::bit_cast<std::uint32_t>(-1234.5f), NUMBER_FLOAT32), "-1234.5");
    EXPECT_EQ(numberText(std::bit_cast<std::uint32_t>(std::numeric_limits<float>::quiet_NaN()), NUMBER_FLOAT32), "nan");
    EXPECT_EQ(numberText(std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity()), NUMBER_FLOAT32), "inf");
    EXPECT_EQ(numberText(glm::packHalf1x16(1.5f), NUMBER_FLOAT16), "1.5000");
    EXPECT_EQ(numberText(255, NUMBER_UNORM8), "1.0000");
    EXPECT_EQ(numberText(~0u, NUMBER_UINT32), "4294967295");  // exact: no float lies between
    EXPECT_EQ(numberText(~0u, NUMBER_INT32), "-1");
    EXPECT_EQ(probeText({3, 4}, {std::bit_cast<std::uint32_t>(1.0f), std::bit_cast<std::uint32_t>(0.5f), 0, 0}, layoutOf(Format::rg32f)),
              "(3, 4)  1.0000  0.50000");
}

TEST(TexelValues, LayoutsOfFormats) {
    EXPECT_EQ(layoutOf(Format::rgba32f), (TexelLayout{16, 0, NUMBER_FLOAT32, 4}));
    EXPECT_EQ(layoutOf(Format::rg16f), (TexelLayout{4, 0, NUMBER_FLOAT16, 2}));
    EXPECT_EQ(layoutOf(Format::rgba8), (TexelLayout{4, 0, NUMBER_UNORM8, 4}));
    EXPECT_EQ(layoutOf(Format::r32ui), (TexelLayout{4, 0, NUMBER_UINT32, 1}));
}

TEST(TexelValues, LayoutsOfFields) {
    const auto field = [](const char* type, std::size_t count = 0) {
        return StructField{.name = "x", .type = type, .offset = 8, .count = count, .size = 4, .members = {}};
    };
    EXPECT_EQ(layoutOf(field("vec3"), 16, 64), (TexelLayout{64, 24, NUMBER_FLOAT32, 3}));
    EXPECT_EQ(layoutOf(field("int"), 0, 64), (TexelLayout{64, 8, NUMBER_INT32, 1}));
    EXPECT_EQ(layoutOf(field("uint64_t"), 0, 64), (TexelLayout{64, 8, NUMBER_UINT32, 1}));
    EXPECT_FALSE(layoutOf(field("mat4"), 0, 64));
    EXPECT_FALSE(layoutOf(field("float", 4), 0, 64));
    EXPECT_FALSE(layoutOf(field("Hit"), 0, 64));
}

TEST(TexelValues, StatisticsLeaveOutliersAndNansOut) {
    std::vector<float> values;
    for (int i = 0; i < 2000; ++i) values.push_back(float(i) / 1999);
    values[7] = 1e30f;
    values[8] = std::numeric_limits<float>::quiet_NaN();
    const Statistics s = statisticsOf(std::as_bytes(std::span(values)), values.size(), layoutOf(Format::r32f), 0);
    EXPECT_NEAR(s.low, 0.005f, 0.002f);
    EXPECT_NEAR(s.high, 0.995f, 0.002f);
    EXPECT_NEAR(s.largest, 0.995f, 0.002f);
}

TEST(TexelValues, StatisticsPickAndMean) {
    const std::vector<glm::vec4> values(100, glm::vec4(0.5f, 1.0f, -2.0f, 1.0f));
    const auto bytes = std::as_bytes(std::span(values));
    EXPECT_FLOAT_EQ(statisticsOf(bytes, 100, layoutOf(Format::rgba32f), 2).high, -2.0f);
    EXPECT_FLOAT_EQ(statisticsOf(bytes, 100, layoutOf(Format::rgba32f), PICK_LENGTH).high, 2.5f);
    EXPECT_FLOAT_EQ(statisticsOf(bytes, 100, layoutOf(Format::rgba32f), 0).largest, 2.0f);
    EXPECT_NEAR(statisticsOf(bytes, 100, layoutOf(Format::rgba32f), 0).mean, -0.5 / 3, 1e-6);  // without opacity
    EXPECT_EQ(statisticsOf({}, 100, layoutOf(Format::rgba32f), 0).high, 0);                    // memory that is too short is not read
}

TEST(TexelValues, ImagesOfTexels) {
    // A field of 3 floats, 4 bytes into each of 2 structs of 20.
    std::vector<float> memory(10);
    for (std::size_t i = 0; i < memory.size(); ++i) memory[i] = float(i);
    const TexelLayout layout{.stride = 20, .offset = 4, .number = NUMBER_FLOAT32, .channels = 3};
    const ImageData image = imageOf(std::as_bytes(std::span(memory)), {2, 1}, layout);
    EXPECT_EQ(image.values, (std::vector<float>{1, 2, 3, 6, 7, 8}));
    EXPECT_FALSE(image.hasOpacity);
    EXPECT_TRUE(imageOf({}, {2, 1}, layoutOf(Format::rgba32f)).hasOpacity) << "as an image file has it";
}

TEST(TexelValues, HistogramsHaveOneRange) {
    ImageData dark = makeImage(100, 10, 1), bright = dark;
    for (std::size_t i = 0; i < 1000; ++i) {
        dark.values[i] = float(i) / 1000;
        bright.values[i] = 1 + float(i) / 1000;
    }
    bright.values[0] = std::numeric_limits<float>::quiet_NaN();
    const std::array<const ImageData*, 2> both{&dark, &bright};
    const Histograms histograms = histogramsOf(both, 0, 10);
    EXPECT_NEAR(histograms.low, 0.01f, 0.002f);
    EXPECT_NEAR(histograms.high, 1.99f, 0.002f);
    for (std::size_t bin = 0; bin < 10; ++bin) {
        EXPECT_NEAR(histograms.shares[0][bin], bin < 5 ? 0.2f : 0.0f, 0.015f) << bin;
        EXPECT_NEAR(histograms.shares[1][bin], bin < 5 ? 0.0f : 0.2f, 0.015f) << bin;
    }
}

TEST(TexelValues, CountsAndBytes) {
    EXPECT_EQ(countText(950), "950");
    EXPECT_EQ(countText(12300), "12.3 k");
    EXPECT_EQ(countText(4.56e6), "4.56 M");
    EXPECT_EQ(bytesText(512), "512 B");
    EXPECT_EQ(bytesText(12.3 * 1024 * 1024), "12.3 MiB");
}

}  // namespace
}  // namespace lodestir
