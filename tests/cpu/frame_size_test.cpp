// SPDX-License-Identifier: MIT
// Sizes that follow the time of frames, on frames whose cost is known.
#include <framework/app/view/frame_size.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace lodestir {
namespace {

constexpr glm::uvec2 window{960, 540};

double pixelsOf(glm::uvec2 size) { return double(size.x) * double(size.y); }

/// Frames one after the other, each costing what its pixels say.
struct Frames {
    FrameSize control;
    glm::uvec2 size;
    int changes = 0;

    Frames(double wanted, glm::uvec2 start) : control(wanted, window, start), size(start) {}
    void run(int count, const std::function<double(double pixels)>& cost) {
        for (int i = 0; i < count; ++i)
            if (const auto next = control.took(cost(pixelsOf(size)))) {
                size = *next;
                ++changes;
            }
    }
};

// If this fails, frames take another time than was asked for, or their size never comes to rest.
TEST(FrameSize, FindsTheTime) {
    for (const double wanted : {8.0, 20.0, 50.0, 130.0})
        for (const double fixed : {0.0, 3.0, 0.5 * wanted})  // of the time, whatever the pixels
            for (const glm::uvec2 start : {glm::uvec2(96, 54), glm::uvec2(480, 270), glm::uvec2(1920, 1080)}) {
                const auto cost = [&](double pixels) { return 2e-4 * pixels + fixed; };
                Frames frames(wanted, start);
                frames.run(100, cost);
                const double largest = cost(pixelsOf(window));
                if (largest < wanted) EXPECT_EQ(frames.size, window);
                else EXPECT_NEAR(cost(pixelsOf(frames.size)) / wanted, 1, 0.15) << wanted << " " << fixed << " " << start.x;
                EXPECT_NEAR(double(frames.size.x) / double(frames.size.y), 16.0 / 9, 0.02);
                const int before = frames.changes;
                EXPECT_LE(before, 8);
                frames.run(1000, cost);
                EXPECT_EQ(frames.changes, before) << "it hunts";
            }
}

TEST(FrameSize, NeverGoesBeyondTheTimeOnItsWay) {
    const auto cost = [](double pixels) { return 1e-4 * pixels + 6; };
    Frames down(10, window), up(10, {96, 54});
    for (int i = 0; i < 200; ++i) {
        down.run(1, cost);
        up.run(1, cost);
        EXPECT_GT(cost(pixelsOf(down.size)), 8.5);
        EXPECT_LT(cost(pixelsOf(up.size)), 11.5);
    }
}

// Times that scatter by a fifth, and every tenth twice as long: in 10000 frames the size may change a few times, and not on and on.
TEST(FrameSize, NoiseDoesNotMoveIt) {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> part(0, 1);
        const double fixed = 10 * part(random);
        const auto cost = [&](double pixels) { return (1e-4 * pixels + fixed) * (0.8 + 0.4 * part(random)) * (part(random) < 0.1 ? 2 : 1); };
        Frames frames(25, window);
        frames.run(10000, cost);
        EXPECT_LE(frames.changes, 16) << seed;
        EXPECT_NEAR((1e-4 * pixelsOf(frames.size) + fixed) * 1.03 / 25, 1, 0.2) << seed;
    }
}

// A machine that has other work now and then, for up to 30 frames: they take three times as long, and the size gives up following that.
TEST(FrameSize, BurstsDoNotMoveItForLong) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(0, 1);
    Frames frames(25, window);
    int burst = 0;
    const auto cost = [&](double pixels) {
        burst = burst > 0 ? burst - 1 : part(random) < 0.01 ? int(30 * part(random)) : 0;
        return 1e-4 * pixels * (0.8 + 0.4 * part(random)) * (burst > 0 ? 3 : 1);
    };
    frames.run(4000, cost);
    const int before = frames.changes;
    EXPECT_LE(before, 60);
    frames.run(4000, cost);
    EXPECT_LE(frames.changes, before + 8);
}

// If this fails, whoever looks at something dearer waits for what was learnt of something cheap.
TEST(FrameSize, FollowsAStepInTheCost) {
    Frames frames(20, window);
    const auto cost = [](double each) { return [each](double pixels) { return each * pixels; }; };
    for (const double each : {1e-4, 4e-4, 1e-4, 1.3e-4, 6e-4}) {
        frames.run(60, cost(each));
        EXPECT_NEAR(cost(each)(pixelsOf(frames.size)) / 20, 1, 0.15) << each;
    }
}

TEST(FrameSize, StaysBetweenTheLeastAndTheWindow) {
    Frames slow(1, window), quick(1000, {100, 80});
    slow.run(300, [](double) { return 50; });
    EXPECT_GE(slow.size.y, 48u);
    EXPECT_LE(slow.size.y, 54u);
    quick.run(300, [](double) { return 50; });
    EXPECT_EQ(quick.size, window);
    FrameSize tiny(1, {40, 20}, {40, 20});
    for (int i = 0; i < 50; ++i) EXPECT_FALSE(tiny.took(50));
}

}  // namespace
}  // namespace lodestir
