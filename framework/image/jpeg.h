// SPDX-License-Identifier: MIT
// JPEG files: pictures that others give to be compared; none are written.
#pragma once
#include <framework/image/image.h>

namespace lodestir {

/// Reads 8 bits a channel and decodes sRGB to linear values in [0, 1]. Channels: 1 grey, 3 RGB.
/// Throws Error naming the file when it cannot be read, is no JPEG file, is damaged, or claims an absurd size.
LODESTIR_API ImageData readJpeg(const std::filesystem::path& path);

}  // namespace lodestir
