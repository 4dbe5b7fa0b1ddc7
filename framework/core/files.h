// SPDX-License-Identifier: MIT
// Files: read whole, written aside and then renamed, found, hashed, cached by content.
#pragma once
#include <framework/core/api.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lodestir {

using Path = std::filesystem::path;

LODESTIR_API std::string readText(const Path& path);                  ///< Error when it cannot be read
LODESTIR_API std::vector<std::byte> readBytes(const Path& path);      ///< Error when it cannot be read
/// Do both name one file that is there, whatever the way to it: links, dots, the case of letters where the system ignores it?
LODESTIR_API bool isSameFile(const Path& a, const Path& b);
/// Writes beside the target and renames, so that a killed process leaves the old file or none. Makes missing folders. Error with the reason.
LODESTIR_API void writeFile(const Path& path, std::span<const std::byte> bytes);
LODESTIR_API void writeFile(const Path& path, std::string_view text);
/// The same for libraries that write to a path themselves: `write` gets the aside path (same extension).
LODESTIR_API void writeAside(const Path& path, const std::function<void(const Path& aside)>& write);
/// A file that knows whether it is whole: writeFile() of the bytes behind their hash. Reading gives nothing where it is missing, damaged or unreadable.
LODESTIR_API void writeSealed(const Path& path, std::span<const std::byte> bytes);
LODESTIR_API std::optional<std::vector<std::byte>> readSealed(const Path& path);

/// 128-bit content hash (two FNV-1a-like/xxhash-like 64-bit lanes are enough: it names cache files, it is no security).
struct LODESTIR_API Hash {
    std::uint64_t a = 0x9e3779b97f4a7c15ull, b = 0xc2b2ae3d27d4eb4full;
    Hash& add(std::span<const std::byte> bytes);
    Hash& add(std::string_view text);
    template <class T> Hash& addValue(const T& value) { return add(std::as_bytes(std::span<const T, 1>(&value, 1))); }
    std::string hex() const;  ///< 32 digits
    bool operator==(const Hash&) const = default;
};

/// The folder for things made once and kept by content: $LODESTIR_CACHE, else $XDG_CACHE_HOME/lodestir, else ~/.cache/lodestir, else a folder in /tmp.
LODESTIR_API Path cacheFolder(std::string_view kind);
/// Where the running library's shaders, passes, scenes and graphs lie: the build and source trees when run from the build, else the install prefix.
LODESTIR_API Path shaderFolder();
LODESTIR_API Path passFolder();
LODESTIR_API Path familyFolder();  ///< the families of passes as sources: headers and shaders that passes share
LODESTIR_API Path sceneFolder();  ///< generated models
LODESTIR_API Path graphFolder();  ///< named configurations, and what the framework runs itself

}  // namespace lodestir
