// SPDX-License-Identifier: MIT
#include <framework/core/error.h>
#include <framework/study/ensemble/block_means.h>

#include <algorithm>

namespace lodestir {

double BlockGrid::share(std::size_t block) const {
    const int x = int(block) % columns() * blockSize, y = int(block) / columns() * blockSize;
    return double(std::min(blockSize, width - x)) * std::min(blockSize, height - y) / (double(width) * height);
}

void BlockMeans::add(const ImageData& image) {
    if (values.empty() && grid.width == 0) grid = {image.width, image.height};
    if (image.width != grid.width || image.height != grid.height || image.channels < 3)
        throw Error("the runs of an ensemble differ in size");
    const std::size_t first = values.size();
    values.resize(first + 3 * grid.count());
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            double* sum = &values[first + 3 * std::size_t(y / blockSize * grid.columns() + x / blockSize)];
            for (int c = 0; c < 3; ++c) sum[c] += double(image.at(x, y, c));
        }
    for (std::size_t block = 0; block < grid.count(); ++block)
        for (std::size_t c = 0; c < 3; ++c) values[first + 3 * block + c] /= grid.share(block) * double(image.pixelCount());
}

void BlockMeans::append(const BlockMeans& more) {
    if (values.empty()) grid = more.grid;
    if (!(grid == more.grid)) throw Error("the runs of an ensemble differ in size");
    values.insert(values.end(), more.values.begin(), more.values.end());
}

Energy energyOf(const BlockMeans& means, std::size_t run) {
    Energy energy{};
    for (std::size_t block = 0; block < means.grid.count(); ++block)
        for (std::size_t c = 0; c < 3; ++c) energy[1 + c] += means.grid.share(block) * means.at(run, block, int(c));
    energy[0] = 0.2126 * energy[1] + 0.7152 * energy[2] + 0.0722 * energy[3];
    return energy;
}

}  // namespace lodestir
