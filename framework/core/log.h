// SPDX-License-Identifier: MIT
// What the program says on stderr: notes, warnings, progress. Facts asked for go to stdout by the commands themselves.
#pragma once
#include <framework/core/api.h>

#include <fmt/format.h>

#include <chrono>
#include <string>
#include <string_view>

namespace lodestir::log {

LODESTIR_API void setQuiet(bool quiet);  ///< drops notes, keeps warnings
LODESTIR_API void writeNote(std::string_view text);
LODESTIR_API void writeWarning(std::string_view text);

template <class... A> void note(fmt::format_string<A...> f, A&&... a) { writeNote(fmt::format(f, std::forward<A>(a)...)); }
template <class... A> void warn(fmt::format_string<A...> f, A&&... a) { writeWarning(fmt::format(f, std::forward<A>(a)...)); }

/// A bar with time left on a terminal; elsewhere a plain line now and then (at most every 10 s), nothing for work under 2 s.
class LODESTIR_API Progress {
public:
    Progress(std::string what, std::size_t total);
    ~Progress();
    void advance(std::size_t steps = 1);

private:
    std::string what_;
    std::size_t total_, done_ = 0;
    std::chrono::steady_clock::time_point start_, shown_;
    bool terminal_, visible_ = false;
};

}  // namespace lodestir::log
