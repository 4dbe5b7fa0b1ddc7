// SPDX-License-Identifier: MIT
// A child process with its output caught, its time limited, and nothing of it left behind.
#pragma once
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lodestir::test {

struct Output {
    int exitCode = -1;      ///< -1: ended by a signal
    int signal = 0;         ///< that ended it
    bool timedOut = false;  ///< it was killed because its time was up
    std::string out, err;
};

using Environment = std::vector<std::pair<std::string, std::string>>;

class Process {
public:
    /// Starts command[0] (looked up in PATH) in a process group of its own; `environment` is added to ours.
    /// std::runtime_error when it can't be.
    Process(const std::vector<std::string>& command, const Environment& environment = {}) : out_(file("out")), err_(file("err")) {
        std::vector<std::string> variables;
        for (char** v = ::environ; *v; ++v) {
            const std::string text = *v, name = text.substr(0, text.find('='));
            bool replaced = false;
            for (const auto& [key, value] : environment) replaced |= key == name;
            if (!replaced) variables.push_back(text);
        }
        for (const auto& [key, value] : environment) variables.push_back(key + "=" + value);

        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_adddup2(&actions, out_, 1);
        posix_spawn_file_actions_adddup2(&actions, err_, 2);
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
        const int failure =
            ::posix_spawnp(&pid_, command[0].c_str(), &actions, &attributes, pointers(command).data(), pointers(variables).data());
        posix_spawn_file_actions_destroy(&actions);
        posix_spawnattr_destroy(&attributes);
        if (failure != 0) throw std::runtime_error("cannot start " + command[0]);
    }
    ~Process() {
        if (running_) {
            kill(SIGKILL);
            ::waitpid(pid_, nullptr, 0);
        }
        ::close(out_);
        ::close(err_);
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// To it and all that it started.
    void kill(int signal) const { ::kill(-pid_, signal); }

    pid_t pid() const { return pid_; }
    /// Still running (asks the system).
    bool running() {
        if (running_ && ::waitpid(pid_, &status_, WNOHANG) == pid_) running_ = false;
        return running_;
    }

    Output wait(std::chrono::duration<double> timeout) {
        Output result;
        const auto end = std::chrono::steady_clock::now() + timeout;
        while (running()) {
            if (std::chrono::steady_clock::now() > end) {
                result.timedOut = true;
                kill(SIGKILL);
                ::waitpid(pid_, &status_, 0);
                running_ = false;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        if (WIFEXITED(status_)) result.exitCode = WEXITSTATUS(status_);
        if (WIFSIGNALED(status_)) result.signal = WTERMSIG(status_);
        result.out = content(out_);
        result.err = content(err_);
        return result;
    }

private:
    /// A file without a name; unlike a pipe it never fills up.
    static int file(const char* name) {
        const int descriptor = ::memfd_create(name, MFD_CLOEXEC);
        if (descriptor < 0) throw std::runtime_error("no memory for a child's output");
        return descriptor;
    }
    static std::string content(int descriptor) {
        std::string text(static_cast<std::size_t>(::lseek(descriptor, 0, SEEK_END)), '\0');
        const ssize_t read = ::pread(descriptor, text.data(), text.size(), 0);
        text.resize(static_cast<std::size_t>(read < 0 ? 0 : read));
        return text;
    }
    static std::vector<char*> pointers(const std::vector<std::string>& texts) {
        std::vector<char*> result;
        for (const std::string& text : texts) result.push_back(const_cast<char*>(text.c_str()));
        result.push_back(nullptr);
        return result;
    }

    int out_, err_;
    pid_t pid_ = -1;
    int status_ = 0;
    bool running_ = true;
};

inline Output runProcess(const std::vector<std::string>& command, const Environment& environment = {},
                         std::chrono::duration<double> timeout = std::chrono::seconds(120)) {
    return Process(command, environment).wait(timeout);
}

}  // namespace lodestir::test
