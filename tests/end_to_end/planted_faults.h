// SPDX-License-Identifier: MIT
// Faults planted in shaders: a fault is a copy of a pass's library under another name, with the changed shader beside it, where it is found before
// the right one.
#pragma once
#include "source_folder.h"

#include <framework/core/files.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lodestir::test {

struct Fault {
    std::string type;  ///< of the faulty pass
    std::string pass;  ///< that it is a copy of
    Path file;         ///< a module of framework/shaders or of a family, or a file of the pass's folder
    std::string right, wrong;
};

/// The library of a pass, whatever family it is in.
inline Path libraryOf(const std::string& pass) {
    for (const auto& family : std::filesystem::directory_iterator(passFolder()))
        if (const Path file = family.path() / pass / ("lib" + pass + ".so"); std::filesystem::exists(file)) return file;
    return {};
}

/// Makes the faulty passes in a folder. The right text must be there exactly once: a fault that can't be planted any more is a failure.
inline void plant(const Path& folder, const std::vector<Fault>& faults) {
    for (const Fault& fault : faults) {
        const Path library = libraryOf(fault.pass), own = library.parent_path().lexically_relative(passFolder());
        std::string text;
        for (const Path& place : {sourceFolder / "framework/shaders", sourceFolder / "passes", sourceFolder / "passes" / own})
            if (std::filesystem::exists(place / fault.file)) text = readText(place / fault.file);
        const std::size_t at = text.find(fault.right);
        ASSERT_NE(at, text.npos) << fault.type << ": not in " << fault.file;
        ASSERT_EQ(text.find(fault.right, at + 1), text.npos) << fault.type << ": twice in " << fault.file;
        text.replace(at, fault.right.size(), fault.wrong);
        writeFile(folder / fault.type / fault.file, text);
        std::filesystem::copy_file(library, folder / fault.type / ("lib" + fault.type + ".so"));
    }
}

}  // namespace lodestir::test
