// SPDX-License-Identifier: MIT
// Numbers as they lie in a port's memory, read and put into words for people. No window, no GPU.
#pragma once
#include <framework/pass/port.h>
#include <framework/graph/struct_layout.h>
#include <framework/image/image.h>
#include <framework/shaders/view/picture.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lodestir {

/// Where the numbers of each texel are.
struct TexelLayout {
    std::uint32_t stride = 16, offset = 0;  ///< bytes
    std::uint32_t number = NUMBER_FLOAT32, channels = 4;
    bool operator==(const TexelLayout&) const = default;
};

LODESTIR_API TexelLayout layoutOf(Format format);
/// Of a field of a struct that is `stride` bytes; none where it is no number or vector (a matrix, an array, a struct).
LODESTIR_API std::optional<TexelLayout> layoutOf(const StructField& field, std::size_t base, std::size_t stride);
LODESTIR_API bool isInteger(std::uint32_t number);
/// What the bits (those of view/color_texels.comp's probe) mean.
LODESTIR_API float numberFrom(std::uint32_t bits, std::uint32_t number);
/// One number: whole numbers whole, others with five significant digits; "nan", "inf".
LODESTIR_API std::string numberText(std::uint32_t bits, std::uint32_t number);
/// "(12, 34)  0.50000  0.25000  1.0000"
LODESTIR_API std::string probeText(glm::ivec2 pixel, const std::array<std::uint32_t, 4>& bits, const TexelLayout& layout);

/// Of up to 65536 evenly spread texels, finite numbers only.
struct Statistics {
    float low = 0, high = 1;  ///< 0.5 % of the picked numbers lie below and above
    float largest = 0;        ///< 99.5 % of all components' absolute values lie below
    double mean = 0;          ///< of all components but opacity
};
LODESTIR_API Statistics statisticsOf(std::span<const std::byte> memory, std::size_t count, const TexelLayout& layout, std::uint32_t pick);

/// The numbers of a picture, as an image file has them: the fourth counts as opacity. Of texels that `memory` doesn't reach they are 0.
LODESTIR_API ImageData imageOf(std::span<const std::byte> memory, glm::uvec2 extent, const TexelLayout& layout);

/// How the picked numbers of up to 65536 evenly spread texels are distributed, for several images over one range. Finite numbers only.
struct Histograms {
    float low = 0, high = 0;                 ///< 0.5 % of the numbers of all lie below and above, and count at the ends
    std::vector<std::vector<float>> shares;  ///< of each image: shares of its numbers, range by range
};
LODESTIR_API Histograms histogramsOf(std::span<const ImageData* const> images, std::uint32_t pick, std::size_t bins);

/// "950", "12.3 k", "4.56 M"
LODESTIR_API std::string countText(double count);
/// "512 B", "12.3 MiB"
LODESTIR_API std::string bytesText(double bytes);

}  // namespace lodestir
