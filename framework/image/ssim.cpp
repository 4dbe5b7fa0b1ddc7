// SPDX-License-Identifier: MIT
#include <framework/image/aces.h>
#include <framework/image/separable_filter.h>
#include <framework/image/srgb.h>
#include <framework/image/ssim.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

namespace lodestir {
namespace {

/// (K1 L)^2 and (K2 L)^2 of the paper with K1 = 0.01, K2 = 0.03 and the range of values L = 1.
constexpr double c1 = 1e-4, c2 = 9e-4;
/// Powers of the scales, finest first (Wang et al. 2003, section 3.2).
constexpr double powers[] = {0.0448, 0.2856, 0.3001, 0.2363, 0.1333};

/// The factors of SSIM at a pixel.
struct Similarity {
    double brightness = 1, structure = 1;
};

SeparableFilter window() {
    const std::vector<double> g = gaussianTaps(1.5, ssimMargin);
    const double sum = std::accumulate(g.begin(), g.end(), 0.0);
    SeparableFilter filter;
    for (double w : g) filter.x.push_back({w / sum, w / sum, w / sum, w / sum});
    filter.y = filter.x;
    return filter;
}

/// Of each pixel; both factors are 1 in the margin.
std::vector<Similarity> similarities(const Luma& test, const Luma& reference) {
    std::vector<Similarity> result(test.values.size());
    const SeparableFilter filter = window();
    const std::size_t width = std::size_t(test.width);
    forStrips(test.height - 2 * ssimMargin, [&](int first, int last) {
        LaneImage products(test.width, last - first + 2 * ssimMargin);
        for (std::size_t i = 0; i < products.pixels.size(); ++i) {
            const double x = test.values[std::size_t(first) * width + i], r = reference.values[std::size_t(first) * width + i];
            products.pixels[i] = {x, r, x * x + r * r, x * r};
        }
        const LaneImage means = filtered(products, filter);
        for (int y = 0; y < means.height; ++y) {
            Similarity* row = result.data() + std::size_t(first + y + ssimMargin) * width + ssimMargin;
            for (int x = 0; x < means.width; ++x) {
                const auto& [mx, mr, squares, product] = means.row(y)[x];
                const double variances = squares - (mx * mx + mr * mr), covariance = product - mx * mr;
                row[x] = {(2 * mx * mr + c1) / (mx * mx + mr * mr + c1), (2 * covariance + c2) / (variances + c2)};
            }
        }
    });
    return result;
}

Luma half(const Luma& image) {
    Luma result = image;
    result.width /= 2, result.height /= 2;
    result.values.clear();
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            const double* v = image.values.data() + std::size_t(2 * y) * std::size_t(image.width) + std::size_t(2 * x);
            result.values.push_back((v[0] + v[1] + v[image.width] + v[image.width + 1]) / 4);
        }
    }
    return result;
}

/// `width` of the mask; empty stays empty.
std::vector<bool> half(const std::vector<bool>& mask, std::size_t width) {
    std::vector<bool> result;
    for (std::size_t row = 0; row + 2 * width <= mask.size(); row += 2 * width)
        for (std::size_t i = row; i + 2 <= row + width; i += 2)
            result.push_back(mask[i] || mask[i + 1] || mask[i + width] || mask[i + width + 1]);
    return result;
}

}  // namespace

Luma::Luma(const ImageData& image, double exposure) : width(image.width), height(image.height) {
    const auto shown = [exposure](float value) {
        return static_cast<double>(encodeSrgb(static_cast<float>(toneMapAces(exposure * static_cast<double>(value)))));
    };
    values.reserve(image.pixelCount());
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        const float* c = image.values.data() + i * static_cast<std::size_t>(image.channels);
        values.push_back(image.channels >= 3 ? 0.2126 * shown(c[0]) + 0.7152 * shown(c[1]) + 0.0722 * shown(c[2]) : shown(c[0]));
    }
}

std::vector<double> ssimMap(const Luma& test, const Luma& reference) {
    std::vector<double> map;
    for (const Similarity& pixel : similarities(test, reference)) map.push_back(pixel.brightness * pixel.structure);
    return map;
}

double msSsim(const Luma& test, const Luma& reference, const std::vector<bool>& mask) {
    const int side = std::min(test.width, test.height);
    std::size_t scales = 0;
    while (scales < std::size(powers) && side >> scales > 2 * ssimMargin) ++scales;
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (scales == 0) return none;
    const double shared = std::accumulate(std::begin(powers), std::end(powers), 0.0) / std::accumulate(powers, powers + scales, 0.0);

    Luma x = test, r = reference;
    std::vector<bool> counts = mask;
    double value = 1;
    for (std::size_t scale = 0; scale < scales; ++scale) {
        if (scale > 0) {
            counts = half(counts, std::size_t(x.width));
            x = half(x), r = half(r);
        }
        const std::vector<Similarity> pixels = similarities(x, r);
        double sum = 0, count = 0;
        for (int row = ssimMargin; row < x.height - ssimMargin; ++row) {
            for (int column = ssimMargin; column < x.width - ssimMargin; ++column) {
                const std::size_t i = std::size_t(row) * std::size_t(x.width) + std::size_t(column);
                if (!counts.empty() && !counts[i]) continue;
                sum += pixels[i].structure * (scale + 1 == scales ? pixels[i].brightness : 1);
                ++count;
            }
        }
        if (count == 0) return none;
        const double mean = sum / count;
        value *= std::pow(mean < 0 ? 0 : mean, powers[scale] * shared);
    }
    return value;
}

}  // namespace lodestir
