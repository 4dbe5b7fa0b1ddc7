// SPDX-License-Identifier: MIT
// Work shared out among processes: each item once, in an order that holds, and a clean end whatever becomes of a worker.
#include <framework/core/error.h>
#include <framework/study/workers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <numeric>
#include <set>
#include <stdexcept>
#include <unistd.h>

namespace lodestir {
namespace {

/// Of `count` items; those below `opening` open what they belong to.
struct Example {
    Work work;
    std::vector<std::size_t> order;
    std::vector<std::string> texts;

    Example(std::size_t count, std::size_t opening) : texts(count) {
        work = {.what = "items", .count = "all items"};
        for (std::size_t i = 0; i < count; ++i) work.items.push_back({.group = i % 3, .scene = 0, .opens = i < opening});
        work.open = [] { return WorkDevice{"no device", true}; };
        work.make = [](std::size_t item) { return std::to_string(item) + " by " + std::to_string(::getpid()) + std::string(item, 'x'); };
        work.take = [this](std::size_t item, const std::string& text) {
            order.push_back(item);
            texts[item] += text;
        };
        work.stops = [] { return false; };
    }
    std::set<std::string> processes() const {
        std::set<std::string> all;
        for (const std::string& text : texts) all.insert(text.substr(text.find("by ") + 3, text.find('x') - text.find("by ") - 3));
        return all;
    }
};

// If this fails, a row is measured twice or never, or against a reference that isn't there.
TEST(Workers, DoEachItemOnceAndWhatOpensFirst) {
    for (const int jobs : {1, 2, 5}) {
        Example example(70'000 / 1000, 4);
        EXPECT_EQ(doWork(example.work, {.count = jobs, .why = {}}), "");
        std::vector<std::size_t> sorted = example.order, all(example.work.items.size());
        std::iota(all.begin(), all.end(), 0);
        std::ranges::sort(sorted);
        EXPECT_EQ(sorted, all) << jobs;
        std::vector<std::size_t> first(example.order.begin(), example.order.begin() + 4);
        std::ranges::sort(first);
        EXPECT_EQ(first, (std::vector<std::size_t>{0, 1, 2, 3})) << jobs;
        for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(example.texts[i].find(std::to_string(i) + " by "), 0u);
        EXPECT_LE(example.processes().size(), std::size_t(jobs));
        EXPECT_EQ(example.processes().contains(std::to_string(::getpid())), jobs == 1) << "several are all children";
    }
}

TEST(Workers, LongTextsComeWhole) {
    Example example(4, 0);
    example.work.make = [](std::size_t item) { return std::string(5'000'000 + item, char('a' + int(item))); };
    EXPECT_EQ(doWork(example.work, {.count = 2, .why = {}}), "");
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(example.texts[i], std::string(5'000'000 + i, char('a' + int(i))));
}

TEST(Workers, OneOfThemIsToldOfTheDevice) {
    Example example(6, 0);
    example.work.open = [] { return WorkDevice{"a GPU", false}; };
    EXPECT_EQ(doWork(example.work, {}), "");
    EXPECT_EQ(example.processes().size(), 1u) << "several processes don't share a GPU unless they are asked to";
}

// If this fails, a study hangs or loses rows where a driver crashes.
TEST(Workers, OneThatDiesEndsTheWorkAndKeepsWhatIsDone) {
    for (const bool throws : {false, true}) {
        Example example(60, 0);
        example.work.make = [throws](std::size_t item) {
            if (item == 20 && throws) throw std::runtime_error("no more memory");
            if (item == 20) std::raise(SIGKILL);
            return std::to_string(item);
        };
        const std::string problem = doWork(example.work, {.count = 2, .why = {}});
        EXPECT_EQ(problem, throws ? "no more memory" : "a worker was ended by signal 9, Killed");
        EXPECT_LT(example.order.size(), 60u);
        EXPECT_EQ(std::set<std::size_t>(example.order.begin(), example.order.end()).size(), example.order.size());
        EXPECT_FALSE(std::ranges::count(example.order, 20u));
    }
}

TEST(Workers, ThatAreStoppedEndWhatTheyHadBegun) {
    Example example(60, 0);
    example.work.stops = [&] { return example.order.size() >= 10; };
    EXPECT_EQ(doWork(example.work, {.count = 2, .why = {}}), "");
    EXPECT_GE(example.order.size(), 10u);
    EXPECT_LE(example.order.size(), 12u) << "one more for each of the two";
}

TEST(Workers, StayWithTheirGroup) {
    std::vector<WorkItem> items;
    for (std::size_t i = 0; i < 6; ++i) items.push_back({.group = i / 3});
    WorkQueue queue(items);
    EXPECT_EQ(queue.next(0), 0u);
    EXPECT_EQ(queue.next(1), 3u) << "of a group that nobody is at";
    EXPECT_EQ(queue.next(1), 4u);
    EXPECT_EQ(queue.next(1), 5u);
    EXPECT_EQ(queue.next(1), 1u) << "helps where there is something left";
    EXPECT_EQ(queue.next(0), 2u);
    EXPECT_TRUE(queue.empty());
    EXPECT_EQ(queue.next(0), WorkQueue::none);
}

}  // namespace
}  // namespace lodestir
