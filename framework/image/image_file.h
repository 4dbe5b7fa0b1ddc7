// SPDX-License-Identifier: MIT
// Image files of any kind this program knows.
#pragma once
#include <framework/image/image.h>

#include <map>
#include <string>

namespace lodestir {

/// Whether a file holds a picture as displayed, 8 or 16 bits of sRGB a channel (PNG, JPEG), and no radiance. False where it cannot be read.
LODESTIR_API bool isDisplayed(const std::filesystem::path& path);

/// Reads OpenEXR, PNG, JPEG or Radiance .hdr, told apart by their first bytes and not by their names.
/// Throws Error naming the file when it is none of them, or as the reader of its kind does.
LODESTIR_API ImageData readImage(const std::filesystem::path& path);

/// Writes .exr (32 bits, with `attributes` as text in its header) or .png (8 bits, clamped; it has no room for attributes).
/// Throws Error when the name ends otherwise, or the file cannot be written.
LODESTIR_API void writeImage(const std::filesystem::path& path, const ImageData& image,
                             const std::map<std::string, std::string>& attributes = {});

}  // namespace lodestir
