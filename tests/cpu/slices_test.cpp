// SPDX-License-Identifier: MIT
// Frames cut into pieces: all rows are done once, pieces keep to the budget once costs are known, and nothing is cut where nobody asked.
#include <framework/graph/slices.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace lodestir {
namespace {

struct Frame {
    std::vector<double> pieces;            ///< milliseconds of each submission
    std::vector<std::uint32_t> leftovers;  ///< rows left after each cut
};

/// Runs dispatches of `rows` rows that cost `cost` milliseconds each through `slices`, as the runner does.
Frame run(Slices& slices, const std::vector<std::pair<std::uint32_t, double>>& dispatches, std::uint32_t grain) {
    Frame frame;
    double piece = 0;
    std::vector<std::pair<Slices::Key, std::uint32_t>> open;
    const auto close = [&] {
        for (const auto& [key, rows] : open) slices.measured(key, rows, rows * dispatches[std::size_t(key.first)].second);
        frame.pieces.push_back(piece);
        open.clear();
        piece = 0;
        slices.close();
    };
    for (std::size_t d = 0; d < dispatches.size(); ++d) {
        const Slices::Key key{int(d), 0};
        std::uint32_t done = 0;
        for (int turns = 0; done < dispatches[d].first; ++turns) {
            if (turns > 10000) {
                ADD_FAILURE() << "no end";
                return frame;
            }
            const std::uint32_t rows = slices.take(key, dispatches[d].first - done, grain);
            if (rows > 0) open.push_back({key, rows});
            piece += rows * dispatches[d].second;
            done += rows;
            EXPECT_TRUE(rows % grain == 0 || done == dispatches[d].first) << rows;
            if (done < dispatches[d].first) frame.leftovers.push_back(dispatches[d].first - done);
            if (rows == 0 || slices.full()) close();
        }
        EXPECT_EQ(done, dispatches[d].first);
    }
    close();
    return frame;
}

TEST(Slices, WithoutABudgetNothingIsCut) {
    Slices slices(0);
    EXPECT_FALSE(slices.cuts());
    EXPECT_EQ(slices.take({0, 0}, 1000, 8), 1000u);
    slices.measured({0, 0}, 1000, 1e6);
    EXPECT_EQ(slices.take({0, 0}, 1000, 8), 1000u);
    EXPECT_FALSE(slices.full());
}

TEST(Slices, PiecesKeepToTheBudgetOnceCostsAreKnown) {
    Slices slices(20);
    const std::vector<std::pair<std::uint32_t, double>> dispatches{{270, 1.0}, {270, 0.01}, {270, 0.5}, {1, 3.0}, {135, 0.02}};
    run(slices, dispatches, 8);
    const Frame second = run(slices, dispatches, 8);
    for (const double piece : second.pieces) EXPECT_LE(piece, 20.001);
    // 413 ms of work: pieces are mostly full, not crumbs.
    EXPECT_LE(second.pieces.size(), 40u);
}

TEST(Slices, OneGrainIsTheLeastEvenWhenItTakesLonger) {
    Slices slices(20);
    run(slices, {{64, 10.0}}, 8);
    const Frame frame = run(slices, {{64, 10.0}}, 8);
    EXPECT_LE(*std::ranges::max_element(frame.pieces), 80.001);
    EXPECT_GE(frame.pieces.size(), 8u);
}

TEST(Slices, CheapFramesAreOnePiece) {
    Slices slices(20);
    const std::vector<std::pair<std::uint32_t, double>> dispatches(6, {540, 0.003});
    run(slices, dispatches, 8);
    EXPECT_EQ(run(slices, dispatches, 8).pieces.size(), 1u);
}

TEST(Slices, NeverLeavesASingleRow) {
    Slices slices(20);
    for (int frame = 0; frame < 3; ++frame)
        for (const std::uint32_t left : run(slices, {{81, 1.3}, {9, 1.3}, {17, 5.0}, {25, 2.5}}, 8).leftovers) EXPECT_GE(left, 2u);
}

TEST(Slices, FollowsACostThatFalls) {
    Slices slices(20);
    run(slices, {{270, 5.0}}, 8);
    for (int frame = 0; frame < 40; ++frame) run(slices, {{270, 0.01}}, 8);
    EXPECT_EQ(run(slices, {{270, 0.01}}, 8).pieces.size(), 1u);
}

}  // namespace
}  // namespace lodestir
