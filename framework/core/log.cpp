// SPDX-License-Identifier: MIT
// Notes, warnings and progress on stderr.
#include <framework/core/log.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <unistd.h>
#include <utility>

namespace lodestir::log {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto patience = 2s;           // work that is done sooner needs no progress shown
constexpr auto terminalPeriod = 100ms;  // a bar that moves smoothly enough
constexpr auto linePeriod = 10s;        // a log that stays readable
constexpr std::size_t barWidth = 30;

/// Quiet or not is a matter of the whole process, like stderr itself.
std::atomic<bool>& quiet() {
    static std::atomic<bool> value{false};
    return value;
}

bool isTerminal() { return ::isatty(STDERR_FILENO) == 1; }

/// One call of fwrite, so that lines of several threads stay whole. On a terminal a progress bar may stand there: it is wiped first.
void writeLine(std::string_view prefix, std::string_view text) {
    const std::string line = fmt::format("{}{}{}\n", isTerminal() ? "\r\x1b[K" : "", prefix, text);
    std::fwrite(line.data(), 1, line.size(), stderr);
}

std::string duration(double seconds) {
    const auto whole = static_cast<long long>(std::ceil(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

double secondsSince(Clock::time_point time) { return std::chrono::duration<double>(Clock::now() - time).count(); }

}  // namespace

void setQuiet(bool value) { quiet() = value; }

void writeNote(std::string_view text) {
    if (!quiet()) writeLine("", text);
}

void writeWarning(std::string_view text) { writeLine("warning: ", text); }

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)), total_(total), start_(Clock::now()), shown_(start_), terminal_(isTerminal()) {}

Progress::~Progress() {
    if (!visible_) return;
    if (terminal_) std::fputs("\r\x1b[K", stderr);
    // Only work that was done counts as done: an exception may end this scope as well.
    if (done_ >= total_) writeNote(fmt::format("{}: done in {}", what_, duration(secondsSince(start_))));
}

void Progress::advance(std::size_t steps) {
    done_ = std::min(done_ + steps, total_);
    const auto now = Clock::now();
    const Clock::duration period = terminal_ ? Clock::duration(terminalPeriod) : Clock::duration(linePeriod);
    if (quiet() || now - start_ < patience || (visible_ && now - shown_ < period)) return;
    visible_ = true;
    shown_ = now;
    const double share = static_cast<double>(done_) / static_cast<double>(std::max<std::size_t>(total_, 1));
    const std::string left = done_ > 0 ? duration(secondsSince(start_) * (1 - share) / share) + " left" : "";
    if (terminal_) {
        const auto full = static_cast<std::size_t>(share * barWidth);
        fmt::print(stderr, "\r\x1b[K{} [{}{}] {:.0f} % {}", what_, std::string(full, '#'), std::string(barWidth - full, '.'), 100 * share,
                   left);
        std::fflush(stderr);
    } else {
        writeLine("", fmt::format("{}: {} of {}, {}", what_, done_, total_, left));
    }
}

}  // namespace lodestir::log
