// SPDX-License-Identifier: MIT
// Mip chains of textures.
#pragma once
#include <framework/scene/scene.h>

#include <cstdint>
#include <vector>

namespace lodestir {

/// Appends all levels of a texture, finest first, each max(1, w >> l) x max(1, h >> l) RGBA8 texels (red in the low byte), down to 1x1.
/// Averages 2x2 boxes in linear light. Returns the number of levels.
std::uint32_t appendMipmaps(const Texture& texture, std::vector<std::uint32_t>& texels);

}  // namespace lodestir
