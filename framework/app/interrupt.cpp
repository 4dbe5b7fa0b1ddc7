// SPDX-License-Identifier: MIT
#include <framework/app/interrupt.h>

#include <csignal>
#include <unistd.h>

namespace lodestir {
namespace {

volatile std::sig_atomic_t received = 0;

constexpr int signals[] = {SIGINT, SIGTERM};

/// Only what starts as default is taken over: `nohup` and scripts have their reasons to ignore a signal.
void take(int signal) {
    struct sigaction before {};
    if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler != SIG_DFL) return;
    struct sigaction action {};
    action.sa_handler = [](int number) {
        received = number;
        constexpr char note[] = "\nending after what is under way; once more ends at once\n";
        [[maybe_unused]] const auto written = ::write(STDERR_FILENO, note, sizeof note - 1);
    };
    action.sa_flags = SA_RESETHAND | SA_RESTART;  // the default again for the next one
    ::sigemptyset(&action.sa_mask);
    ::sigaction(signal, &action, nullptr);
}

void giveBack(int signal) {
    struct sigaction now {};
    if (::sigaction(signal, nullptr, &now) == 0 && now.sa_handler != SIG_IGN) std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptWatch::InterruptWatch() {
    received = 0;
    for (const int signal : signals) take(signal);
}

InterruptWatch::~InterruptWatch() {
    for (const int signal : signals) giveBack(signal);
}

int InterruptWatch::signal() const { return received; }

const char* InterruptWatch::name() const { return received == SIGINT ? "SIGINT" : "SIGTERM"; }

}  // namespace lodestir
