// SPDX-License-Identifier: MIT
// What a glTF file may write where it names other files: percent-encoded paths (RFC 3986) and data URIs (RFC 2397).
#pragma once
#include <framework/core/files.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lodestir {

/// "%20" -> " " and so on; a percent sign that starts no two hexadecimal digits stays as it is.
std::string percentDecode(std::string_view text);

/// Does it hold its data itself?
bool isDataUri(std::string_view uri);

/// Bytes of base64 text with or without padding; nothing when another character occurs or the length cannot be.
std::optional<std::vector<std::byte>> decodeBase64(std::string_view text);

/// Reads what `uri` names: a data URI, or a file relative to `folder` or of this machine (tried decoded, then as written, each with backslashes
/// as they are, then as slashes). Error when it is a network address, is missing, is a git-lfs pointer or is malformed.
std::vector<std::byte> readUri(const std::string& uri, const Path& folder);

}  // namespace lodestir
