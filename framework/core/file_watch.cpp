// SPDX-License-Identifier: MIT
#include <framework/core/file_watch.h>

#include <system_error>

namespace lodestir {

FileWatch::Stamp FileWatch::stampOf(const Path& file) {
    std::error_code missing;
    const auto time = std::filesystem::last_write_time(file, missing);
    if (missing) return {};
    const std::uintmax_t size = std::filesystem::file_size(file, missing);
    return missing ? Stamp{} : Stamp{time.time_since_epoch().count(), size};
}

void FileWatch::watch(const std::vector<Path>& files) {
    std::map<Path, Stamp> next;
    for (const Path& file : files) {
        const auto known = known_.find(file);
        next[file] = known != known_.end() ? known->second : stampOf(file);
    }
    known_ = std::move(next);
}

std::vector<Path> FileWatch::changed() {
    std::vector<Path> files;
    for (auto& [file, known] : known_) {
        const Stamp now = stampOf(file);
        if (now == Stamp{} || now == known) continue;
        known = now;
        files.push_back(file);
    }
    return files;
}

}  // namespace lodestir
