// SPDX-License-Identifier: MIT
// Whatever a child does, its parent is told and goes on.
#include <framework/core/child.h>
#include <framework/core/error.h>

#include <gtest/gtest.h>

#include <csignal>
#include <thread>

#include <unistd.h>

namespace lodestir {
namespace {

using namespace std::chrono_literals;

TEST(Child, ReturnsText) {
    const std::string text(1'000'000, 'x');  // more than a pipe holds
    const ChildEnd end = runInChild([&] { return text; }, 60s);
    EXPECT_EQ(end.way, ChildEnd::Way::returned);
    EXPECT_EQ(end.text, text);
    EXPECT_EQ(runInChild([] { return std::string(); }, 60s).way, ChildEnd::Way::returned);
}

TEST(Child, TellsExceptions) {
    const ChildEnd end = runInChild([]() -> std::string { throw Error("it is broken", "mend it"); }, 60s);
    EXPECT_EQ(end.way, ChildEnd::Way::threw);
    EXPECT_EQ(end.text, "it is broken; mend it");
}

TEST(Child, DiesAlone) {
    for (const int signal : {SIGKILL, SIGTERM, SIGUSR1}) {
        const ChildEnd end = runInChild(
            [signal] {
                ::raise(signal);
                return std::string("alive");
            },
            60s);
        EXPECT_EQ(end.way, ChildEnd::Way::died);
        EXPECT_EQ(end.signal, signal);
    }
    const ChildEnd left = runInChild([]() -> std::string { ::_exit(3); }, 60s);
    EXPECT_EQ(left.way, ChildEnd::Way::died);
    EXPECT_EQ(left.signal, 0);
}

TEST(Child, IsEndedWhenItsTimeIsUp) {
    const auto start = std::chrono::steady_clock::now();
    const ChildEnd end = runInChild(
        [] {
            std::this_thread::sleep_for(60s);
            return std::string();
        },
        0.2s);
    EXPECT_EQ(end.way, ChildEnd::Way::overdue);
    EXPECT_LT(std::chrono::steady_clock::now() - start, 30s);
}

}  // namespace
}  // namespace lodestir
