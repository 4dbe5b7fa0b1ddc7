// SPDX-License-Identifier: MIT
// A shader file together with everything that it may include, found by a scan of the #include lines alone.
#pragma once
#include <framework/core/files.h>

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lodestir::gpu {

/// One #include line of a text.
struct Include {
    int line = 0;                    ///< counted from 1
    std::size_t begin = 0, end = 0;  ///< of the line in the text, without its line feed
    std::string name;                ///< what stands between the quotes or brackets
    int target = -1;                 ///< index into IncludeClosure::texts(); -1 when there is no such file
};

struct ShaderText {
    std::string name;  ///< path, or the include name of a generated text
    Path path;         ///< empty for a generated text
    std::string text;
    std::vector<Include> includes;
};

/// The texts are a superset of what the preprocessor takes: conditions aren't evaluated, so a hash over them is never too
/// coarse, and a file that doesn't exist counts only if the preprocessor asks for it. Text 0 is the entry.
class IncludeClosure {
public:
    /// A name is looked up in the including file's folder, then in `folders`, then in `generated`; <name> skips the first.
    /// Error when the entry can't be read.
    IncludeClosure(const Path& entry, const std::vector<Path>& folders, const std::map<std::string, std::string>& generated);

    const std::vector<ShaderText>& texts() const { return texts_; }
    std::vector<Path> files() const;
    /// The texts and how they hang together; not the paths, so that two checkouts share their cached results.
    void addTo(Hash& hash) const;

private:
    int find(const Include& include, bool local, const Path& from);
    int add(std::string name, Path path, std::string text);

    const std::vector<Path>* folders_;
    const std::map<std::string, std::string>* generated_;
    std::vector<ShaderText> texts_;
    std::map<std::string, int> known_;  ///< by canonical path, or by "<name>" for a generated text
};

}  // namespace lodestir::gpu
