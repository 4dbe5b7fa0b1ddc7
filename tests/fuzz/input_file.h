// SPDX-License-Identifier: MIT
// What every fuzz target needs: its bytes as a file in memory, and a judge of what a reader made of it.
#pragma once
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/core/log.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>

#include <unistd.h>

namespace lodestir::fuzz {

/// A folder in main memory, of this process alone and gone with it.
class Folder {
public:
    Folder() : path_("/dev/shm/lodestir-fuzz-" + std::to_string(::getpid())) { std::filesystem::create_directories(path_); }
    ~Folder() {
        std::error_code none;
        std::filesystem::remove_all(path_, none);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    const Path& path() const { return path_; }
    /// Not written aside: this is done thousands of times a second.
    Path write(const std::string& name, std::span<const std::uint8_t> bytes) const {
        const Path file = path_ / name;
        std::FILE* out = std::fopen(file.c_str(), "wb");
        if (!out || std::fwrite(bytes.data(), 1, bytes.size(), out) != bytes.size() || std::fclose(out) != 0) std::abort();
        return file;
    }

private:
    Path path_;
};

/// Runs a reader. It may refuse with an Error that says something; anything else that it throws ends the process: a finding.
template <class Read> void expectErrorOrResult(const Read& read) {
    try {
        read();
    } catch (const Error& error) {
        for (const Problem& problem : error.problems()) {
            if (problem.what.empty()) std::abort();
        }
        if (error.problems().empty()) std::abort();
    }
}

}  // namespace lodestir::fuzz
