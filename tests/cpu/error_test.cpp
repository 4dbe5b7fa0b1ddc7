// SPDX-License-Identifier: MIT
// Texts, order and hints of problems.
#include <framework/core/error.h>

#include <gtest/gtest.h>

namespace lodestir {
namespace {

// If this fails, editors and terminals can no longer jump to the place of a mistake.
TEST(Problem, TextLeavesOutEmptyParts) {
    EXPECT_EQ((Problem{{"a.json", 3, 5}, "what", "hint"}.text()), "a.json:3:5: what; hint");
    EXPECT_EQ((Problem{{"a.json", 3, 0}, "what", ""}.text()), "a.json:3: what");
    EXPECT_EQ((Problem{{"a.json", 0, 7}, "what", ""}.text()), "a.json: what");
    EXPECT_EQ((Problem{{"", 3, 5}, "what", ""}.text()), "3:5: what");
    EXPECT_EQ((Problem{{}, "what", "hint"}.text()), "what; hint");
    EXPECT_EQ((Problem{{"a.json"}, "", "hint"}.text()), "a.json; hint");
}

// If this fails, people read the mistakes of a file in the order in which some pass over it happened to find them.
TEST(Error, SortsByPlaceAndKeepsTheOrderAtOnePlace) {
    const Error error(
        std::vector<Problem>{{{"b", 1, 1}, "1"}, {{"a", 10, 2}, "2"}, {{"a", 9, 30}, "3"}, {{"a", 10, 2}, "4"}, {{"a"}, "5"}});
    EXPECT_STREQ(error.what(), "a: 5\na:9:30: 3\na:10:2: 2\na:10:2: 4\nb:1:1: 1");
    EXPECT_EQ(error.problems().size(), 5u);
}

TEST(Problems, RaiseThrowsEverythingAtOnce) {
    Problems problems;
    EXPECT_TRUE(problems.empty());
    EXPECT_NO_THROW(problems.raise());
    problems.add({"g.json", 7, 1}, "late", "do this");
    problems.add(Error(Where{"g.json", 2, 4}, "early"));
    try {
        problems.raise();
        FAIL() << "raise() must throw";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "g.json:2:4: early\ng.json:7:1: late; do this");
    }
}

TEST(DidYouMean, FindsSlips) {
    const std::vector<std::string> names{"rounds", "radius", "vertexMapping", "spp", "M"};
    EXPECT_EQ(didYouMean("round", names), "did you mean \"rounds\"?");
    EXPECT_EQ(didYouMean("raduis", names), "did you mean \"radius\"?");  // two neighbours swapped
    EXPECT_EQ(didYouMean("Radius", names), "did you mean \"radius\"?");
    EXPECT_EQ(didYouMean("vertex_mapping", names), "did you mean \"vertexMapping\"?");
    EXPECT_EQ(didYouMean("vertex", names), "did you mean \"vertexMapping\"?");
    EXPECT_EQ(didYouMean("ssp", names), "did you mean \"spp\"?");
}

TEST(DidYouMean, ListsWhenNothingIsClose) {
    EXPECT_EQ(didYouMean("albedo", std::vector<std::string>{"radius", "rounds"}), "known: radius, rounds");
    EXPECT_EQ(didYouMean("x", std::vector<std::string>{"M"}), "known: M");  // one letter for another is no slip
    EXPECT_EQ(didYouMean("albedo", {}), "");
    EXPECT_EQ(didYouMean("zzzz", std::vector<std::string>{"a", "b", "c", "d", "e", "f", "g", "h", "i", "j"}),
              "known: a, b, c, d, e, f, g, h, and 2 more");
}

}  // namespace
}  // namespace lodestir
