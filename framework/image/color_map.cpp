// SPDX-License-Identifier: MIT
// Colours for error maps.
#include <framework/image/color_map.h>
#include <framework/image/srgb.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lodestir {
namespace {

// Least-squares polynomials of degree 5 through the 256 sRGB colours of "magma" (van der Walt and Smith 2015, made for even steps of
// lightness); off by at most 0.022. Degree 7 comes closer but isn't monotone in lightness.
constexpr double coefficients[3][6] = {{-0.021, 1.083, -0.073, 6.170, -11.408, 5.234},
                                       {0.011, 0.182, 1.587, -6.577, 11.196, -5.416},
                                       {-0.004, 2.247, 2.842, -23.746, 31.858, -12.442}};

float component(int c, double t) {
    double value = 0;
    for (int i = 5; i >= 0; --i) value = value * t + coefficients[c][i];
    return decodeSrgb(static_cast<float>(std::clamp(value, 0.0, 1.0)));
}

}  // namespace

ImageData colorMap(const ImageData& image, double top) {
    ImageData colors = makeImage(image.width, image.height, 3);
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        const double value = static_cast<double>(image.values[i * static_cast<std::size_t>(image.channels)]);
        const double t = std::clamp(top > 0 ? value / top : value > 0 ? 1.0 : 0.0, 0.0, 1.0);
        for (int c = 0; c < 3; ++c) {
            colors.values[i * 3 + static_cast<std::size_t>(c)] = std::isnan(value) ? (c == 1 ? 1.0f : 0.0f) : component(c, t);
        }
    }
    return colors;
}

}  // namespace lodestir
