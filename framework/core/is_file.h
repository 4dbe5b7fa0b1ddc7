// SPDX-License-Identifier: MIT
// Whether a path names a file, asked without exceptions.
#pragma once
#include <framework/core/api.h>

#include <filesystem>

namespace lodestir {

/// A file, or a link to one. False for all else: a name that is too long, links that lead round in a circle, a folder that may not be read.
LODESTIR_API bool isFile(const std::filesystem::path& path);

}  // namespace lodestir
