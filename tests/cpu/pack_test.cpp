// SPDX-License-Identifier: MIT
// If these fail, the GPU reads normals, tangents and colours otherwise than the CPU wrote them: base/pack.test.comp has the same answers.
#include <framework/scene/upload/pack.h>

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace lodestir;

TEST(Pack, KnownNormals) {
    EXPECT_EQ(packNormal({0, 0, 1}), 0u);
    EXPECT_EQ(packNormal({1, 0, 0}), 0x00007fffu);
    EXPECT_EQ(packNormal({-1, 0, 0}), 0x00008001u);
    EXPECT_EQ(packNormal({0, 1, 0}), 0x7fff0000u);
    EXPECT_EQ(packNormal({0, 0, -1}), 0x7fff7fffu);
    EXPECT_EQ(packNormal({1, -2, 2}), 0xcccd1999u);
    EXPECT_EQ(packNormal({-2, 1, -2}), 0x4ccc999au);
    EXPECT_EQ(unpackNormal(0x7fff7fffu), glm::vec3(0, 0, -1));
}

TEST(Pack, VectorsWithoutDirectionAreZ) {
    EXPECT_EQ(packNormal({0, 0, 0}), 0u);
    EXPECT_EQ(packNormal({std::numeric_limits<float>::quiet_NaN(), 0, 1}), 0u);
    EXPECT_EQ(packNormal({std::numeric_limits<float>::infinity(), 0, 1}), 0u);
}

TEST(Pack, RoundTrip) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-1, 1);
    for (int i = 0; i < 100'000; ++i) {
        const glm::vec3 n = glm::normalize(glm::vec3(uniform(random), uniform(random), uniform(random)));
        const std::uint32_t bits = packNormal(n);
        EXPECT_LT(glm::distance(unpackNormal(bits), n), 9e-5f);
        EXPECT_LT(glm::distance(unpackNormal(packNormal(unpackNormal(bits))), unpackNormal(bits)), 1e-6f);  // once packed it stays
        const glm::vec4 tangent = unpackTangent(packTangent({n, i % 2 ? -1 : 1}));
        EXPECT_LT(glm::distance(glm::vec3(tangent), n), 1.8e-4f);
        EXPECT_EQ(tangent.w, i % 2 ? -1 : 1);
    }
}

TEST(Pack, KnownTangents) {
    EXPECT_EQ(packTangent({0, 0, 1, 1}), 0x00010000u);  // 0 would mean "no tangent"
    EXPECT_EQ(packTangent({0, 0, 1, -1}), 1u);
    EXPECT_EQ(packTangent({1, 0, 0, 1}), 0x00007ffeu);
    EXPECT_EQ(packTangent({1, 0, 0, -1}), 0x00007fffu);
}

// Of any colour that 16-bit files can hold, dark ones included, at most half a thousandth is lost, or what half floats don't resolve.
TEST(Pack, DarkColorsKeepTheirPrecision) {
    for (int i = 1; i < 65536; ++i) {
        const float value = float(i) / 65535;
        const float back = glm::unpackHalf2x16(packColor(glm::vec4(value)).x).x;
        ASSERT_NEAR(back, value, std::max(value * 0x1p-11f, 0x1p-25f)) << i;
    }
}

TEST(Pack, Colors) {
    EXPECT_EQ(packColor({1, 0, 0.1f, 0.5f}), glm::uvec2(0x00003c00u, 0x38002e66u));
    EXPECT_EQ(packColor({0.001f, 131.0f / 65535, 7, 1}), glm::uvec2(0x18181419u, 0x3c004700u));
    EXPECT_EQ(packColor({-1, 1e6f, std::numeric_limits<float>::quiet_NaN(), 1}), glm::uvec2(0x7bff0000u, 0x3c000000u));
}
