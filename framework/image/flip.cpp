// SPDX-License-Identifier: MIT
// FLIP. Formulas and constants: Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images", and Andersson et al. 2021,
// "Visualizing Errors in Rendered High Dynamic Range Images", as their published program has them.
#include <framework/core/error.h>
#include <framework/image/aces.h>
#include <framework/image/flip.h>
#include <framework/image/separable_filter.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace lodestir {
namespace {

struct Rgb {
    double r, g, b;
};
/// Relative to white, so that white is (1, 1, 1).
struct Xyz {
    double x, y, z;
};
/// CIELAB; a and b shrunk with lightness (Hunt effect).
struct Lab {
    double l, a, b;
};

constexpr Xyz white{0.950428545, 1, 1.088900371};

Xyz xyzOf(const Rgb& c) {
    return {(10135552 * c.r + 8788810 * c.g + 4435075 * c.b) / 24577794 / white.x,
            (2613072 * c.r + 8788810 * c.g + 887015 * c.b) / 12288897 / white.y,
            (1425312 * c.r + 8788810 * c.g + 70074185 * c.b) / 73733382 / white.z};
}

Rgb rgbOf(const Xyz& relative) {
    const Xyz c{relative.x * white.x, relative.y * white.y, relative.z * white.z};
    return {3.241003275 * c.x - 1.537398934 * c.y - 0.498615861 * c.z, -0.969224334 * c.x + 1.875930071 * c.y + 0.041554224 * c.z,
            0.055639423 * c.x - 0.204011202 * c.y + 1.057148933 * c.z};
}

Lab labOf(const Rgb& color) {
    constexpr double delta = 6.0 / 29;
    const auto f = [](double t) { return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29; };
    const Xyz c = xyzOf(color);
    const double x = f(c.x), y = f(c.y), z = f(c.z), l = 116 * y - 16;
    return {l, 0.01 * l * 500 * (x - y), 0.01 * l * 200 * (y - z)};
}

/// Without the care that std::hypot takes of values near the ends of the range.
double lengthOf(double x, double y) { return std::sqrt(x * x + y * y); }

/// HyAB distance, compressed.
double distanceOf(const Lab& p, const Lab& q) { return std::pow(std::abs(p.l - q.l) + lengthOf(p.a - q.a, p.b - q.b), 0.7); }

/// What is seen of colours: the contrast sensitivity of the eye in the opponent space YCxCz, sums of Gaussians
/// a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees. Lanes: Y, Cx, and the two Gaussians of Cz, which are separable only apart.
SeparableFilter colorFilter(double pixelsPerDegree) {
    struct Gaussian {
        double a, b;
    };
    constexpr Gaussian gaussians[4] = {{1, 0.0047}, {1, 0.0053}, {34.1, 0.04}, {13.5, 0.025}};
    constexpr double widest = 0.04, pi = std::numbers::pi;
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * pixelsPerDegree));
    SeparableFilter filter;
    Lanes sum{};
    for (int i = -radius; i <= radius; ++i) {
        Lanes weight;
        for (std::size_t c = 0; c < 4; ++c) {
            const auto& [a, b] = gaussians[c];
            weight[c] = std::sqrt(a * std::sqrt(pi / b)) * std::exp(-pi * pi * i * i / (pixelsPerDegree * pixelsPerDegree) / b);
            sum[c] += weight[c];
        }
        filter.x.push_back(weight);
    }
    sum[2] = sum[3] = std::hypot(sum[2], sum[3]);  // together they weigh 1 over both directions
    for (Lanes& weight : filter.x)
        for (std::size_t c = 0; c < 4; ++c) weight[c] /= sum[c];
    filter.y = filter.x;
    return filter;
}

/// Divides the positive weights by their sum, and the negative ones by theirs.
void normalize(std::vector<double>& weights) {
    double positive = 0, negative = 0;
    for (double w : weights) (w > 0 ? positive : negative) += std::abs(w);
    for (double& w : weights) w /= w > 0 ? positive : negative > 0 ? negative : 1;
}

/// Edges and points of the size that the eye detects best, as first and second derivatives of a Gaussian. Lanes: d/dx, d/dy, d2/dx2, d2/dy2.
SeparableFilter featureFilter(double pixelsPerDegree) {
    const double sigma = 0.5 * 0.082 * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    std::vector<double> g = gaussianTaps(sigma, radius), first = g, second = g;
    for (int i = -radius; i <= radius; ++i) {
        const auto k = static_cast<std::size_t>(i + radius);
        first[k] *= -i;
        second[k] *= i * i / (sigma * sigma) - 1;
    }
    normalize(g);
    normalize(first);
    normalize(second);
    SeparableFilter filter;
    for (std::size_t k = 0; k < g.size(); ++k) {
        filter.x.push_back({first[k], g[k], second[k], g[k]});
        filter.y.push_back({g[k], first[k], g[k], second[k]});
    }
    return filter;
}

/// Everything that the error of a pixel needs but the pixels.
struct Eye {
    explicit Eye(double pixelsPerDegree) : color(colorFilter(pixelsPerDegree)), feature(featureFilter(pixelsPerDegree)) {}

    SeparableFilter color, feature;
    double largest = distanceOf(labOf({0, 1, 0}), labOf({0, 0, 1}));  ///< distance of two colours: pure green and pure blue

    /// Distances to 0.4 of the largest are spread over 0 to 0.95, the few that are larger over the rest.
    double colorError(const Lab& p, const Lab& q) const {
        const double distance = distanceOf(p, q), knee = 0.4 * largest;
        return distance < knee ? 0.95 * distance / knee : 0.95 + 0.05 * (distance - knee) / (largest - knee);
    }
};

/// Maps a value to what the screen shows of it, linear in [0, 1]. NaN stays.
using Display = std::function<double(double)>;

/// Rows of one image as the eye has them.
class Seen {
public:
    Seen(const Eye& eye, const ImageData& image, const Display& display, int first, int last)
        : Seen(eye, bordered(image.width, image.height, first, last, eye.color.radius(), [&](int x, int y) {
                   const float* c = image.values.data() + image.index(x, y, 0);
                   const double r = display(c[0]);
                   return opponent(image.channels >= 3 ? Rgb{r, display(c[1]), display(c[2])} : Rgb{r, r, r});
               })) {}

    Lab color(std::size_t pixel) const {
        const auto& [y, cx, cz1, cz2] = colors_.pixels[pixel];
        const double relativeY = (y + 16) / 116;
        const Rgb c = rgbOf({relativeY + cx / 500, relativeY, relativeY - (cz1 + cz2) / 200});
        return labOf({std::clamp(c.r, 0.0, 1.0), std::clamp(c.g, 0.0, 1.0), std::clamp(c.b, 0.0, 1.0)});
    }
    double edge(std::size_t pixel) const { return lengthOf(features_.pixels[pixel][0], features_.pixels[pixel][1]); }
    double point(std::size_t pixel) const { return lengthOf(features_.pixels[pixel][2], features_.pixels[pixel][3]); }

private:
    Seen(const Eye& eye, const LaneImage& opponents)
        : colors_(filtered(opponents, eye.color)), features_(filtered(luminances(opponents, eye), eye.feature)) {}

    /// YCxCz, the last twice as colorFilter() has it.
    static Lanes opponent(const Rgb& color) {
        const Xyz c = xyzOf(color);
        const double cz = 200 * (c.y - c.z);
        return {116 * c.y - 16, 500 * (c.x - c.y), cz, cz};
    }

    /// With the border that features need, which is a little less than that of colours.
    static LaneImage luminances(const LaneImage& opponents, const Eye& eye) {
        const int spare = eye.color.radius() - eye.feature.radius();
        LaneImage image(opponents.width - 2 * spare, opponents.height - 2 * spare);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) image.row(y)[x].fill((opponents.row(y + spare)[x + spare][0] + 16) / 116);
        return image;
    }

    LaneImage colors_, features_;
};

/// Raises each pixel of `errors` to the error of the images as displayed, where that is larger; NaN is larger than all.
void raise(std::vector<double>& errors, const Eye& eye, const ImageData& test, const ImageData& reference, const Display& display) {
    forStrips(test.height, [&](int first, int last) {
        const Seen x(eye, test, display, first, last), r(eye, reference, display, first, last);
        const std::size_t offset = test.index(0, first, 0) / static_cast<std::size_t>(test.channels);
        const std::size_t count = static_cast<std::size_t>(last - first) * static_cast<std::size_t>(test.width);
        for (std::size_t i = 0; i < count; ++i) {
            const double feature = std::max(std::abs(x.edge(i) - r.edge(i)), std::abs(x.point(i) - r.point(i)));
            const double error = std::pow(eye.colorError(x.color(i), r.color(i)), 1 - std::sqrt(feature * std::numbers::sqrt2 / 2));
            if (std::isnan(error) || error > errors[offset + i]) errors[offset + i] = error;
        }
    });
}

void check(const ImageData& test, const ImageData& reference, const FlipOptions& options) {
    if (test.width != reference.width || test.height != reference.height || test.channels != reference.channels)
        throw Error("FLIP needs two images of one size, with the same channels");
    if (test.values.empty()) throw Error("FLIP of images without pixels");
    if (!(options.pixelsPerDegree > 0 && options.pixelsPerDegree < 1000))
        throw Error("FLIP at " + std::to_string(options.pixelsPerDegree) + " pixels per degree", "screens have from 10 to 200");
    if (options.exposures) {
        const auto& [start, stop, count] = *options.exposures;
        if (!std::isfinite(start) || !std::isfinite(stop) || count < 1)
            throw Error("FLIP over " + std::to_string(count) + " exposures from " + std::to_string(start) + " to " + std::to_string(stop) +
                            " stops",
                        "it needs at least one exposure, and finite stops");
    }
}

}  // namespace

FlipExposures flipExposures(const ImageData& reference) {
    std::vector<double> luminances;
    for (std::size_t i = 0; i < reference.pixelCount(); ++i) {
        const float* c = reference.values.data() + i * static_cast<std::size_t>(reference.channels);
        const double luminance = reference.channels >= 3 ? 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2] : static_cast<double>(c[0]);
        if (std::isfinite(luminance)) luminances.push_back(luminance);
    }
    std::ranges::sort(luminances);
    if (luminances.empty() || luminances.back() <= 0) return {};
    double median = luminances[luminances.size() / 2];
    if (median <= 0) {
        const auto lit = std::ranges::upper_bound(luminances, 0.0);
        median = lit[(luminances.end() - lit) / 2];
    }
    // toneMapAces(x) = 0.85 as a quadratic equation; its larger root.
    constexpr double shown = 0.85;
    const auto& k = acesCoefficients;
    const double a = k[0] - shown * k[3], b = k[1] - shown * k[4], c = k[2] - shown * k[5];
    const double x = (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
    const double start = std::log2(x / luminances.back()), stop = std::log2(x / median);
    return {start, stop, std::max(2, static_cast<int>(std::ceil(stop - start)))};
}

std::vector<double> flipLdr(const ImageData& test, const ImageData& reference, const FlipOptions& options) {
    check(test, reference, options);
    std::vector<double> errors(test.pixelCount());
    raise(errors, Eye(options.pixelsPerDegree), test, reference, [](double value) { return std::clamp(value, 0.0, 1.0); });
    return errors;
}

std::vector<double> flipHdr(const ImageData& test, const ImageData& reference, const FlipOptions& options) {
    check(test, reference, options);
    const FlipExposures exposures = options.exposures ? *options.exposures : flipExposures(reference);
    const Eye eye(options.pixelsPerDegree);
    std::vector<double> errors(test.pixelCount());
    for (int i = 0; i < exposures.count; ++i) {
        const double scale = std::exp2(exposures.stops(i));
        raise(errors, eye, test, reference, [scale](double value) { return toneMapAces(scale * value); });
    }
    return errors;
}

}  // namespace lodestir
