// SPDX-License-Identifier: MIT
// PNG files: the form in which results are looked at.
#pragma once
#include <framework/image/image.h>

#include <string_view>

namespace lodestir {

/// Writes 8 bits a channel: grey, RGB or RGBA (1, 3 or 4 channels), clamped to [0, 1] and sRGB-encoded; opacity stays linear, NaN
/// becomes 0. Throws Error when the channels are others or the file cannot be written.
LODESTIR_API void writePng(const std::filesystem::path& path, const ImageData& image);

/// Reads 8 or 16 bits a channel and decodes sRGB to linear values in [0, 1]. Channels: 1 grey, 2 with opacity, 3 RGB, 4 RGBA.
/// Throws Error naming the file when it cannot be read, is no PNG file, is damaged or cut, or claims an absurd size.
LODESTIR_API ImageData readPng(const std::filesystem::path& path);

/// Do all chunks up to the last lie inside these bytes? stb takes the memory that a chunk claims to need before it looks for the chunk.
LODESTIR_API bool hasWholeChunks(std::string_view png);

}  // namespace lodestir
