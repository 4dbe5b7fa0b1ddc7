// SPDX-License-Identifier: MIT
// Images cut into blocks whose means are what ensembles keep of each run: pixels have heavy tails, means of many pixels less so.
#pragma once
#include <framework/image/image.h>

#include <array>
#include <cstddef>
#include <vector>

namespace lodestir {

/// Width and height of a block; those at the right and bottom edges may be smaller.
inline constexpr int blockSize = 16;

struct BlockGrid {
    int width = 0, height = 0;  ///< of the image, pixels

    int columns() const { return (width + blockSize - 1) / blockSize; }
    int rows() const { return (height + blockSize - 1) / blockSize; }
    std::size_t count() const { return std::size_t(columns()) * std::size_t(rows()); }
    double share(std::size_t block) const;  ///< of the image's pixels
    bool operator==(const BlockGrid&) const = default;
};

/// Means of red, green and blue by run and block.
struct BlockMeans {
    BlockGrid grid;
    std::vector<double> values;  ///< run by run, in each block by block (rows from the top), in each the three colours

    std::size_t runs() const { return grid.count() == 0 ? 0 : values.size() / (3 * grid.count()); }
    double at(std::size_t run, std::size_t block, int colour) const {
        return values[(run * grid.count() + block) * 3 + std::size_t(colour)];
    }
    /// One more run, of an image with at least three channels. Error when it has another size.
    void add(const ImageData& image);
    void append(const BlockMeans& more);
};

/// What the energy of an image is measured in: Rec. 709 luminance and the three colours.
inline constexpr std::array<const char*, 4> energyNames{"luminance", "red", "green", "blue"};
using Energy = std::array<double, 4>;
/// Means over a run's image.
Energy energyOf(const BlockMeans& means, std::size_t run);

}  // namespace lodestir
