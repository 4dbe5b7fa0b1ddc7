// SPDX-License-Identifier: MIT
// If these fail, the GPU reads normals, tangents and colours otherwise than the CPU wrote them: base/pack.test.comp has the same answers.
#include <framework/scene/pack.h>

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

TEST(Pack, Colors) {
    EXPECT_EQ(packColor({0.2f, 0, 1, 0.5f}), 0x80ff0033u);
    EXPECT_EQ(packColor({-1, 2, 0, 1}), 0xff00ff00u);
}
