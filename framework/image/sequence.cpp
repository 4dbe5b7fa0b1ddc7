// SPDX-License-Identifier: MIT
#include <framework/core/error.h>
#include <framework/image/sequence.h>

#include <charconv>
#include <optional>
#include <system_error>

namespace lodestir {
namespace {

constexpr std::string_view numberMark = "%d";

/// The number in a name between what stands before and behind it.
std::optional<int> numberIn(std::string_view name, std::string_view before, std::string_view behind) {
    if (name.size() <= before.size() + behind.size() || !name.starts_with(before) || !name.ends_with(behind)) return {};
    const std::string_view digits = name.substr(before.size(), name.size() - before.size() - behind.size());
    int number = 0;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (failure != std::errc() || end != digits.data() + digits.size() || digits.front() == '-') return {};
    return number;
}

}  // namespace

bool isSequence(const Path& path) { return path.filename().string().find(numberMark) != std::string::npos; }

std::map<int, Path> sequenceFiles(const Path& path) {
    const std::string pattern = path.filename().string();
    const std::size_t mark = pattern.find(numberMark);
    if (mark == pattern.npos || pattern.find(numberMark, mark + 1) != pattern.npos)
        throw Error(Where{path.string()}, "names no sequence", "write %d, once, for the number of the frame");
    std::map<int, Path> files;
    std::error_code failure;
    for (const auto& entry : std::filesystem::directory_iterator(path.has_parent_path() ? path.parent_path() : ".", failure)) {
        const std::string name = entry.path().filename().string();
        const auto number =
            numberIn(name, std::string_view(pattern).substr(0, mark), std::string_view(pattern).substr(mark + numberMark.size()));
        if (!number) continue;
        const auto [place, isNew] = files.emplace(*number, entry.path());
        if (!isNew) throw Error(Where{path.string()}, "has two files of frame " + std::to_string(*number), "remove one of them");
    }
    if (files.empty()) throw Error(Where{path.string()}, "there is no file of this sequence", "%d stands for the number of the frame");
    return files;
}

}  // namespace lodestir
