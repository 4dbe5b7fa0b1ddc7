// SPDX-License-Identifier: MIT
// Errors that are followed from frame to frame: those that a comparison of saved images gives, on curves that begin when something is changed.
#include <framework/app/view/running_error.h>
#include <framework/image/metrics.h>

#include <gtest/gtest.h>

namespace lodestir {
namespace {

ImageData picture(float first, int channels = 4) {
    ImageData image = makeImage(8, 4, channels);
    image.hasOpacity = channels == 4;
    for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = first + 0.01f * float(i % 13);
    return image;
}

// If this fails, the panel shows other errors than `lodestir compare` of what is saved.
TEST(RunningError, IsThatOfTheMetrics) {
    const ImageData a = picture(0.3f), b = picture(0.5f), reference = picture(0.4f, 3);
    RunningError error;
    EXPECT_TRUE(error.due());
    error.measure(1, a, b, nullptr, "A", 0);
    ASSERT_EQ(error.numbers()->b.size(), 1u);
    EXPECT_TRUE(error.numbers()->a.empty()) << "A has no error against itself";
    EXPECT_EQ(error.numbers()->b[0].mse, evaluate("mse", withoutOpacity(b), withoutOpacity(a)));
    EXPECT_EQ(error.numbers()->b[0].relmse, evaluate("relmse", withoutOpacity(b), withoutOpacity(a)));

    error.clear();
    error.measure(1, a, b, &reference, "reference.exr", 0);
    EXPECT_EQ(error.numbers()->reference, "reference.exr");
    EXPECT_EQ(error.numbers()->a.at(0).relmse, evaluate("relmse", withoutOpacity(a), reference));
    EXPECT_EQ(error.numbers()->b.at(0).relmse, evaluate("relmse", withoutOpacity(b), reference));
}

TEST(RunningError, CurvesBeginWhenSomethingChanges) {
    const ImageData a = picture(0.3f), b = picture(0.5f);
    RunningError error;
    for (std::uint32_t frames = 1; frames <= 3; ++frames) error.measure(frames, a, b, nullptr, "A", 0);
    error.measure(3, a, picture(0.6f), nullptr, "A", 0);
    ASSERT_EQ(error.numbers()->b.size(), 3u) << "a frame counts once";
    EXPECT_GT(error.numbers()->b[2].mse, error.numbers()->b[1].mse);
    error.restart();
    EXPECT_EQ(error.numbers()->b.size(), 3u) << "what was measured stands until there is something else";
    error.measure(5, a, b, nullptr, "A", 0);
    EXPECT_EQ(error.numbers()->b.size(), 1u);
}

TEST(RunningError, CurvesStayShort) {
    const ImageData a = picture(0.3f), b = picture(0.5f);
    RunningError error;
    for (std::uint32_t frames = 1; frames <= 2000; ++frames) error.measure(frames, a, b, nullptr, "A", 0);
    const std::vector<ErrorPoint>& curve = error.numbers()->b;
    EXPECT_LE(curve.size(), 256u);
    EXPECT_GT(curve.size(), 100u);
    EXPECT_EQ(curve.front().frames, 1u);
    EXPECT_EQ(curve.back().frames, 2000u);
}

TEST(RunningError, TellsWhatCannotBeCompared) {
    RunningError error;
    error.measure(1, picture(0.3f), picture(0.5f, 1), nullptr, "A", 0);
    EXPECT_TRUE(error.numbers()->b.empty());
    EXPECT_EQ(error.numbers()->without, "B is 8x4 with 1 colours, A 8x4 with 3 colours");
}

}  // namespace
}  // namespace lodestir
