// SPDX-License-Identifier: MIT
// Texels of an image port as floats.
#pragma once
#include <framework/pass/port.h>
#include <framework/image/image.h>

#include <cstddef>
#include <span>

namespace lodestir {

/// Decodes row-major texels of a format into floats with the format's channels. r32ui gives the number itself (exact up to 2^24).
ImageData decodeTexels(std::span<const std::byte> bytes, Format format, glm::uvec2 extent);

}  // namespace lodestir
