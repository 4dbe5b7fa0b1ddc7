// SPDX-License-Identifier: MIT
// parallelFor and parallelInvoke: every index once, the same bits, exceptions, nesting.
#include <framework/core/tasks.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace lodestir {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnceInChunksOfTheGrain) {
    for (const std::size_t count : {0u, 1u, 2u, 7u, 64u, 1000u, 12345u}) {
        for (const std::size_t grain : {0u, 1u, 3u, 100u, 100000u}) {
            std::vector<std::atomic<int>> visits(count);
            parallelFor(count, grain, [&](std::size_t begin, std::size_t end) {
                EXPECT_LT(begin, end);
                EXPECT_GE(end - begin, std::min(count, grain));
                for (std::size_t i = begin; i < end; ++i) ++visits[i];
            });
            for (const auto& visit : visits) ASSERT_EQ(visit, 1) << count << " by " << grain;
        }
    }
}

TEST(ParallelFor, GivesTheSameBitsAsALoop) {
    std::vector<float> loop(50000), parallel(50000);
    const auto value = [](std::size_t i) { return std::sin(static_cast<float>(i) * 0.37f); };
    for (std::size_t i = 0; i < loop.size(); ++i) loop[i] = value(i);
    for (int repeat = 0; repeat < 5; ++repeat) {
        parallelFor(parallel.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) parallel[i] = value(i);
        });
        ASSERT_EQ(loop, parallel);
    }
}

// If this fails, an error in a worker ends the program, or a different error is shown each time.
TEST(ParallelFor, RethrowsTheExceptionOfTheFirstChunk) {
    for (int repeat = 0; repeat < 50; ++repeat) {
        try {
            parallelFor(1000, 1, [](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    if (i >= 300) throw std::runtime_error(std::to_string(i));
                }
            });
            FAIL() << "parallelFor must throw";
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "300");
        }
    }
    std::atomic<int> sum{0};
    parallelFor(100, 1, [&](std::size_t begin, std::size_t end) { sum += static_cast<int>(end - begin); });
    EXPECT_EQ(sum, 100) << "the cores must be free again";
}

TEST(ParallelFor, NestsWithoutDeadlock) {
    std::atomic<int> sum{0};
    parallelFor(20, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            parallelFor(50, 1, [&](std::size_t innerBegin, std::size_t innerEnd) { sum += static_cast<int>(innerEnd - innerBegin); });
        }
    });
    EXPECT_EQ(sum, 1000);
}

/// Sum of [begin, end) by halving, as tree builders recurse.
long long halve(long long begin, long long end) {
    if (end - begin <= 4) {
        long long sum = 0;
        for (long long i = begin; i < end; ++i) sum += i;
        return sum;
    }
    const long long middle = (begin + end) / 2;
    long long left = 0, right = 0;
    parallelInvoke([&] { left = halve(begin, middle); }, [&] { right = halve(middle, end); });
    return left + right;
}

TEST(ParallelInvoke, RunsBothAndNests) { EXPECT_EQ(halve(0, 100000), 4999950000ll); }

TEST(ParallelInvoke, RethrowsTheFirst) {
    const auto failing = [](const char* what) { return [what] { throw std::runtime_error(what); }; };
    for (int repeat = 0; repeat < 20; ++repeat) {
        try {
            parallelInvoke(failing("first"), failing("second"));
            FAIL() << "parallelInvoke must throw";
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "first");
        }
    }
    EXPECT_THROW(parallelInvoke([] {}, failing("second")), std::runtime_error);
}

TEST(WorkerCount, IsAtLeastOne) { EXPECT_GE(workerCount(), 1u); }

}  // namespace
}  // namespace lodestir
