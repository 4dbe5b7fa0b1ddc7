// SPDX-License-Identifier: MIT
// What is said on stderr where it isn't a terminal.
#include <framework/core/log.h>

#include <gtest/gtest.h>

namespace lodestir {
namespace {

TEST(Log, QuietDropsNotesAndKeepsWarnings) {
    testing::internal::CaptureStderr();
    log::note("{} rays", 3);
    log::warn("no {}", "sky");
    log::setQuiet(true);
    log::note("dropped");
    log::warn("kept");
    log::setQuiet(false);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "3 rays\nwarning: no sky\nwarning: kept\n");
}

// If this fails, logs of batch jobs fill up with bars.
TEST(Progress, SaysNothingForShortWork) {
    testing::internal::CaptureStderr();
    {
        log::Progress progress("short", 100);
        for (int i = 0; i < 150; ++i) progress.advance();
        log::Progress empty("empty", 0);
        empty.advance();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace lodestir
