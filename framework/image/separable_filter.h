// SPDX-License-Identifier: MIT
// Separable filters of pixels that hold four values, each with a kernel of its own: what FLIP and SSIM spend their time on.
#pragma once
#include <framework/image/image.h>

#include <array>
#include <functional>
#include <vector>

namespace lodestir {

/// In doubles: FLIP takes roots of differences of what should cancel.
using Lanes = std::array<double, 4>;

struct LaneImage {
    int width = 0, height = 0;
    std::vector<Lanes> pixels;  ///< row by row

    LaneImage(int w, int h) : width(w), height(h), pixels(std::size_t(w) * std::size_t(h)) {}
    Lanes* row(int y) { return pixels.data() + std::size_t(y) * std::size_t(width); }
    const Lanes* row(int y) const { return pixels.data() + std::size_t(y) * std::size_t(width); }
};

/// Weights at -radius to radius, along x and along y; an odd number, the same for both.
struct SeparableFilter {
    std::vector<Lanes> x, y;

    int radius() const { return static_cast<int>(x.size()) / 2; }
};

/// exp(-x^2 / (2 sigma^2)) at the whole numbers from -radius to radius.
std::vector<double> gaussianTaps(double sigma, int radius);

/// Only where the filter has all it needs: the result is smaller by its radius on each side. Empty where nothing is left.
LaneImage filtered(const LaneImage& image, const SeparableFilter& filter);

/// The pixels at(x, y), 0 <= x < width and first <= y < last, and `border` more on each side that repeat the outermost of the whole image.
LaneImage bordered(int width, int height, int first, int last, int border, const std::function<Lanes(int x, int y)>& at);

/// Calls body(first, last) for strips of rows that together are [0, height), on all cores: filtering by strips saves memory.
void forStrips(int height, const std::function<void(int first, int last)>& body);

}  // namespace lodestir
