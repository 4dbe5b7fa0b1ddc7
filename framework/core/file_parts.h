// SPDX-License-Identifier: MIT
// Files of several parts, which are read into where they are to stay and written from where they are: no second copy of what is large.
#pragma once
#include <framework/core/files.h>

#include <memory>
#include <span>

namespace lodestir {

/// A file read part after part. Error when it cannot be read.
class LODESTIR_API FileReader {
public:
    explicit FileReader(const Path& path);
    ~FileReader();
    FileReader(const FileReader&) = delete;
    FileReader& operator=(const FileReader&) = delete;

    std::size_t size() const;
    bool read(std::span<std::byte> bytes);  ///< fills them all; false where the file ends before

private:
    struct File;
    std::unique_ptr<File> file_;
};

/// writeFile with parts that lie one after the other.
LODESTIR_API void writeParts(const Path& path, std::span<const std::span<const std::byte>> parts);

}  // namespace lodestir
