// SPDX-License-Identifier: MIT
#include <framework/core/child.h>

#include <framework/core/error.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lodestir {
namespace {

constexpr char returned = 'r', threw = 't';  // the first byte that the child sends; its text follows

void writeAll(int pipe, const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t count = ::write(pipe, text.data() + done, text.size() - done);
        if (count < 0 && errno != EINTR) return;
        done += std::size_t(std::max<ssize_t>(count, 0));
    }
}

[[noreturn]] void beChild(const std::function<std::string()>& work, int pipe) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody would end it if we were killed
    std::string text;
    try {
        text = returned + work();
    } catch (const std::exception& exception) {
        text = threw + std::string(exception.what());
    }
    writeAll(pipe, text);
    std::_Exit(0);  // destructors of globals are the parent's business
}

/// All that the child writes until it closes the pipe; false when the time was up first.
bool readAll(int pipe, std::chrono::steady_clock::time_point end, std::string& text) {
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now()).count();
        pollfd waiting{pipe, POLLIN, 0};
        const int ready = ::poll(&waiting, 1, int(std::clamp<long long>(left, 0, 1'000'000)));
        if (ready == 0 && left <= 0) return false;
        if (ready <= 0) continue;
        std::array<char, 4096> part;
        const ssize_t count = ::read(pipe, part.data(), part.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return true;
        text.append(part.data(), std::size_t(count));
    }
}

}  // namespace

ChildEnd runInChild(const std::function<std::string()>& work, std::chrono::duration<double> limit) {
    std::fflush(nullptr);  // or both would write what is buffered
    int pipe[2];
    if (::pipe2(pipe, O_CLOEXEC) != 0) throw Error("no pipe to a child process: " + std::generic_category().message(errno));
    const auto most = std::chrono::hours(24 * 365);  // a clock cannot count to any double
    const auto end = std::chrono::steady_clock::now() +
                     std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::min<std::chrono::duration<double>>(limit, most));
    const pid_t child = ::fork();
    if (child == 0) {
        ::close(pipe[0]);
        beChild(work, pipe[1]);
    }
    const int reason = errno;
    ::close(pipe[1]);
    std::string text;
    const bool inTime = child > 0 && readAll(pipe[0], end, text);
    ::close(pipe[0]);
    if (child < 0) throw Error("no child process: " + std::generic_category().message(reason));
    if (!inTime) ::kill(child, SIGKILL);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
    if (!inTime) return {ChildEnd::Way::overdue, {}, 0};
    if (text.empty()) return {ChildEnd::Way::died, {}, WIFSIGNALED(status) ? WTERMSIG(status) : 0};
    return {text[0] == returned ? ChildEnd::Way::returned : ChildEnd::Way::threw, text.substr(1), 0};
}

}  // namespace lodestir
