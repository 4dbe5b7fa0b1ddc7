// SPDX-License-Identifier: MIT
// A command of the program in this process.
#pragma once
#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace lodestir {

/// Parses the command's arguments and runs it, which must end well; returns what was printed. `add`: addCompare, addLod, ...
inline std::string printed(void (*add)(CLI::App&, std::function<int()>&), const char* command, std::vector<std::string> arguments) {
    CLI::App app;
    std::function<int()> run;
    add(app, run);
    arguments.insert(arguments.begin(), command);
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
    app.parse(arguments);
    testing::internal::CaptureStdout();
    try {
        EXPECT_EQ(run(), 0);
    } catch (...) {
        testing::internal::GetCapturedStdout();
        throw;
    }
    return testing::internal::GetCapturedStdout();
}

}  // namespace lodestir
