// SPDX-License-Identifier: MIT
// Whether a path names a file, asked without exceptions, and which file a name in another file means.
#pragma once
#include <framework/core/api.h>

#include <filesystem>
#include <string>

namespace lodestir {

/// A file, or a link to one. False for all else: a name that is too long, links that lead round in a circle, a folder that may not be read.
LODESTIR_API bool isFile(const std::filesystem::path& path);

/// What a file in `folder` means by a name (an absolute one needs no folder): that path; but where it is no file and would be one with its
/// backslashes as slashes, as programs on Windows write them, that one.
LODESTIR_API std::filesystem::path namedPath(const std::filesystem::path& folder, const std::string& name);

}  // namespace lodestir
