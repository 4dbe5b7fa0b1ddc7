// SPDX-License-Identifier: MIT
#include <framework/image/gradient.h>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

/// Keeps noise in flat regions from counting as a loss of edges.
constexpr double c = 0.0026;

struct Gray {
    int width, height;
    std::vector<double> values;

    double at(int x, int y) const {
        return values[std::size_t(std::clamp(y, 0, height - 1)) * std::size_t(width) + std::size_t(std::clamp(x, 0, width - 1))];
    }
};

/// Means of 2 x 2 pixels; an odd last row or column stands for two.
Gray halved(const Luma& luma) {
    const Gray image{luma.width, luma.height, luma.values};
    Gray half{(luma.width + 1) / 2, (luma.height + 1) / 2, {}};
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x)
            half.values.push_back((image.at(2 * x, 2 * y) + image.at(2 * x + 1, 2 * y) + image.at(2 * x, 2 * y + 1) +
                                   image.at(2 * x + 1, 2 * y + 1)) /
                                  4);
    return half;
}

double gradient(const Gray& image, int x, int y) {
    double dx = 0, dy = 0;
    for (int i = -1; i <= 1; ++i) {
        dx += (image.at(x + 1, y + i) - image.at(x - 1, y + i)) / 3;
        dy += (image.at(x + i, y + 1) - image.at(x + i, y - 1)) / 3;
    }
    return std::sqrt(dx * dx + dy * dy) + 0 * image.at(x, y);  // the filter skips the middle, but a broken pixel has to show
}

}  // namespace

std::vector<double> gradientSimilarity(const Luma& test, const Luma& reference) {
    const Gray x = halved(test), r = halved(reference);
    std::vector<double> squares;
    for (int row = 0; row < x.height; ++row)
        for (int column = 0; column < x.width; ++column) {
            const double mx = gradient(x, column, row), mr = gradient(r, column, row);
            squares.push_back((2 * mx * mr + c) / (mx * mx + mr * mr + c));
        }
    std::vector<double> similarities;
    for (int row = 0; row < test.height; ++row)
        for (int column = 0; column < test.width; ++column)
            similarities.push_back(squares[std::size_t(row / 2) * std::size_t(x.width) + std::size_t(column / 2)]);
    return similarities;
}

}  // namespace lodestir
