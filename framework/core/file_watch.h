// SPDX-License-Identifier: MIT
// Notices that files change, by asking now and then for their times and sizes: works on every file system, and with editors that rename.
#pragma once
#include <framework/core/files.h>

#include <cstdint>
#include <map>
#include <vector>

namespace lodestir {

class LODESTIR_API FileWatch {
public:
    /// Watches these files and no others. What was watched before is remembered, so that no change gets lost.
    void watch(const std::vector<Path>& files);
    /// The files whose time or size is another one than when they were last reported, or first watched. One that is gone counts when it is back.
    std::vector<Path> changed();
    std::size_t size() const { return known_.size(); }

private:
    struct Stamp {
        std::int64_t time = 0;  ///< 0: there is no such file
        std::uintmax_t size = 0;
        bool operator==(const Stamp&) const = default;
    };
    static Stamp stampOf(const Path& file);
    std::map<Path, Stamp> known_;
};

}  // namespace lodestir
