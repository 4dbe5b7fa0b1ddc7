// SPDX-License-Identifier: MIT
#include <framework/core/tasks.h>
#include <framework/image/separable_filter.h>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

/// Each strip filters the rows around it again: with 64 rows and a radius of 10 that is a third of one direction.
constexpr int stripRows = 64;

/// The weighted sum of pixels that lie `stride` apart, the first of them at `pixel`.
Lanes weighted(const Lanes* pixel, std::size_t stride, const std::vector<Lanes>& weights) {
    Lanes sum{};
    for (const Lanes& weight : weights) {
        for (std::size_t c = 0; c < 4; ++c) sum[c] += weight[c] * (*pixel)[c];
        pixel += stride;
    }
    return sum;
}

}  // namespace

std::vector<double> gaussianTaps(double sigma, int radius) {
    std::vector<double> taps;
    for (int i = -radius; i <= radius; ++i) taps.push_back(std::exp(-i * i / (2 * sigma * sigma)));
    return taps;
}

LaneImage filtered(const LaneImage& image, const SeparableFilter& filter) {
    const int width = std::max(0, image.width - 2 * filter.radius()), height = std::max(0, image.height - 2 * filter.radius());
    LaneImage alongX(width, image.height), both(width, height);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < width; ++x) alongX.row(y)[x] = weighted(image.row(y) + x, 1, filter.x);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) both.row(y)[x] = weighted(alongX.row(y) + x, std::size_t(width), filter.y);
    return both;
}

LaneImage bordered(int width, int height, int first, int last, int border, const std::function<Lanes(int x, int y)>& at) {
    LaneImage image(width + 2 * border, last - first + 2 * border);
    for (int y = 0; y < image.height; ++y) {
        Lanes* row = image.row(y);
        const int from = std::clamp(first + y - border, 0, height - 1);
        for (int x = 0; x < width; ++x) row[border + x] = at(x, from);
        std::fill_n(row, border, row[border]);
        std::fill_n(row + border + width, border, row[border + width - 1]);
    }
    return image;
}

void forStrips(int height, const std::function<void(int first, int last)>& body) {
    const int strips = (height + stripRows - 1) / stripRows;
    parallelFor(std::size_t(std::max(0, strips)), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const int first = static_cast<int>(i) * stripRows;
            body(first, std::min(first + stripRows, height));
        }
    });
}

}  // namespace lodestir
