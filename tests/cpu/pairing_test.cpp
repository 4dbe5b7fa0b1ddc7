// SPDX-License-Identifier: MIT
// Pairings for paired spatial reuse. If these fail, a pixel isn't its partner's partner, so that shifts are taken for others' and images are biased; or
// partners lie elsewhere than the radius says.
#include <passes/restir/pairing_textures/pairing_table.h>

#include <gtest/gtest.h>

#include <chrono>

namespace lodestir {
namespace {

constexpr std::uint32_t sizes[] = {254, 230, 210, 246};

glm::dvec2 deviation(const std::vector<glm::ivec2>& steps) {
    glm::dvec2 sum(0);
    for (const glm::dvec2 s : steps) sum += s * s;
    return glm::sqrt(sum / double(steps.size()));
}

TEST(Pairing, PixelsAreTheirPartnersPartners) {
    for (const std::uint32_t size : sizes) {
        const std::vector<glm::ivec2> steps = pairingSteps(size, pairingSigma(20), size);
        const int side = int(size);
        for (int i = 0; i < side * side; ++i) {
            const glm::ivec2 step = steps[std::size_t(i)], place = glm::ivec2(i % side, i / side);
            ASSERT_NE(step, glm::ivec2(0)) << i;
            ASSERT_LE(std::max(std::abs(step.x), std::abs(step.y)), 127) << "8 bits";
            const glm::ivec2 there = (place + step + side) % side;
            ASSERT_EQ(steps[std::size_t(there.y * side + there.x)], -step) << i;
        }
    }
}

// Images of three sizes under all eight transforms, every pixel: as restir/pairing.glsl has it.
TEST(Pairing, HoldsInImagesHoweverTheTableLies) {
    const std::uint32_t size = 230;
    const std::vector<glm::ivec2> steps = pairingSteps(size, pairingSigma(30), 7);
    for (const glm::ivec2 image : {glm::ivec2(64, 36), glm::ivec2(517, 301), glm::ivec2(1280, 720)})
        for (int transform = 0; transform < 8; ++transform) {
            const bool flipX = transform & 1, flipY = transform & 2, transpose = transform & 4;
            const auto partner = [&](glm::ivec2 p) {
                glm::uvec2 at = (glm::uvec2(p) + glm::uvec2(1'234'567, 7'654'321)) % size;
                if (flipX) at.x = size - 1 - at.x;
                if (flipY) at.y = size - 1 - at.y;
                if (transpose) std::swap(at.x, at.y);
                glm::ivec2 step = steps[std::size_t(at.y) * size + at.x];
                if (transpose) std::swap(step.x, step.y);
                if (flipX) step.x = -step.x;
                if (flipY) step.y = -step.y;
                return p + step;
            };
            int inside = 0;
            for (int y = 0; y < image.y; ++y)
                for (int x = 0; x < image.x; ++x) {
                    const glm::ivec2 q = partner({x, y});
                    if (q.x < 0 || q.y < 0 || q.x >= image.x || q.y >= image.y) continue;
                    ++inside;
                    ASSERT_EQ(partner(q), glm::ivec2(x, y)) << transform;
                }
            EXPECT_GT(inside, image.x * image.y / 3);
        }
}

TEST(Pairing, PartnersAreAsFarAsTheRadiusSays) {
    for (const double radius : {1.6, 2.0, 3.0, 5.0, 10.0, 20.0, 30.0, 50.0})
        for (const std::uint32_t size : sizes) {
            const double sigma = pairingSigma(radius);
            const std::vector<glm::ivec2> steps = pairingSteps(size, sigma, 3);
            const glm::dvec2 is = deviation(steps);
            EXPECT_NEAR(is.x / sigma, 1, 0.03) << radius << ", " << size;
            EXPECT_NEAR(is.y / sigma, 1, 0.03) << radius << ", " << size;
            double distance = 0;
            for (const glm::dvec2 s : steps) distance += glm::length(s);
            distance /= double(steps.size());
            // A disk's mean distance; few shuffles leave a distribution that is not normal yet.
            if (radius >= 10) {
                EXPECT_NEAR(distance / (2 * radius / 3), 1, 0.03) << radius << ", " << size;
            }
        }
    // There is none nearer than one pass of shuffling.
    EXPECT_NEAR(deviation(pairingSteps(254, 0.5, 3)).x, std::sqrt(2.0 / 3), 0.02);
}

// Known answers for whole passes (the standard deviation of a 2x2 shuffle walk).
TEST(Pairing, ShufflesWander) {
    for (const auto& [passes, sigma] : {std::pair(1, 0.816), {2, 1.779}, {5, 3.042}, {20, 6.289}, {129, 16.03}}) {
        PairingLinks links(254, 11);
        for (int pass = 0; pass < passes; ++pass) links.shuffle(std::uint32_t(pass), 1);
        EXPECT_NEAR(std::sqrt(variance(links.steps())) / sigma, 1, 0.02) << passes;
    }
}

TEST(Pairing, SlotsKnowNothingOfEachOther) {
    std::vector<glm::ivec2> steps[4];
    for (int slot = 0; slot < 4; ++slot) steps[slot] = pairingSteps(sizes[slot], pairingSigma(20), std::uint64_t(slot) + 1);
    const double sigma = pairingSigma(20);
    for (int a = 0; a < 4; ++a)
        for (int b = 0; b < a; ++b) {
            glm::dmat2 products(0);
            int same = 0;
            constexpr int side = 480;
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) {
                    const auto at = [&](int slot) { return steps[slot][(std::size_t(y) % sizes[slot]) * sizes[slot] + std::size_t(x) % sizes[slot]]; };
                    products += glm::outerProduct(glm::dvec2(at(a)), glm::dvec2(at(b)));
                    same += at(a) == at(b);
                }
            products /= double(side) * side * sigma * sigma;
            for (int i = 0; i < 4; ++i) EXPECT_NEAR(products[i / 2][i % 2], 0, 0.02) << a << ", " << b;
            // Two normal steps agree in one of 4 pi sigma^2 pixels.
            EXPECT_NEAR(double(same) / side / side * 4 * std::numbers::pi * sigma * sigma, 1, 0.3) << a << ", " << b;
        }
}

TEST(Pairing, IsQuick) {
    double best = 1;
    for (int run = 0; run < 3; ++run) {
        const auto start = std::chrono::steady_clock::now();
        for (int slot = 0; slot < 3; ++slot) pairingSteps(sizes[slot], pairingSigma(30), 1);
        best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    std::printf("three tables, radius 30: %.0f ms\n", 1e3 * best);
    EXPECT_LT(best, 0.3);
}

}  // namespace
}  // namespace lodestir
