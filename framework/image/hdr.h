// SPDX-License-Identifier: MIT
// Radiance .hdr files: the usual form of environment maps.
#pragma once
#include <framework/image/image.h>

namespace lodestir {

/// Reads RGB pixels with a shared exponent (Ward 1991, Real Pixels, Graphics Gems II), flat or run-length encoded, in any of the eight
/// orientations. Values are radiance: what EXPOSURE and COLORCORR lines say the pixels were multiplied by is undone. Pixels that aren't square
/// and other primaries are told and not undone.
/// Throws Error naming the file when it cannot be read, is no such file, is damaged or cut, or claims an absurd size.
LODESTIR_API ImageData readHdr(const std::filesystem::path& path);

}  // namespace lodestir
