// SPDX-License-Identifier: MIT
// An image in main memory.
#pragma once
#include <framework/core/api.h>

#include <cassert>
#include <cstddef>
#include <filesystem>
#include <vector>

namespace lodestir {

/// Pixels of one or more channels, row by row, top row first. Colour is linear radiance with Rec. 709 primaries.
struct ImageData {
    int width = 0, height = 0, channels = 0;
    std::vector<float> values;  ///< width x height x channels
    bool hasOpacity = false;    ///< the last channel is opacity, not light

    std::size_t pixelCount() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
    std::size_t index(int x, int y, int c) const {
        assert(x >= 0 && x < width && y >= 0 && y < height && c >= 0 && c < channels);
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
                   static_cast<std::size_t>(channels) +
               static_cast<std::size_t>(c);
    }
    float& at(int x, int y, int c) { return values[index(x, y, c)]; }
    float at(int x, int y, int c) const { return values[index(x, y, c)]; }
};

/// An image of zeros.
LODESTIR_API ImageData makeImage(int width, int height, int channels);

/// The first `count` channels.
LODESTIR_API ImageData firstChannels(const ImageData& image, int count);

/// All channels but opacity: the same picture has the same error whether it was saved with opacity or without.
LODESTIR_API ImageData withoutOpacity(const ImageData& image);

/// Throws Error naming the file when its header asks for more than an image can sensibly have: 65536 pixels a side, 2^27 pixels
/// (16384 x 8192), 64 channels, 2^30 values. A damaged header would otherwise take all memory before anything else is noticed.
LODESTIR_API void checkImageSize(const std::filesystem::path& path, long long width, long long height, long long channels);

}  // namespace lodestir
