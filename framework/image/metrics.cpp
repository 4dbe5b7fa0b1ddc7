// SPDX-License-Identifier: MIT
// Error metrics. A new one is a line in the table: its name, its definition, the error of each pixel, and how pixels become one value (or,
// where it is no mean of such errors, the value alone).
#include <framework/core/error.h>
#include <framework/image/gradient.h>
#include <framework/image/metrics.h>
#include <framework/image/srgb.h>
#include <framework/image/ssim.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace lodestir {
namespace {

/// Keeps relative errors finite where the reference is black; against a median luminance of 0.18, pixels darker than about 0.1 weigh less.
constexpr double epsilon = 0.01;
/// Share of the pixels, those of the largest errors, that trimmed metrics leave out.
constexpr double trimmedShare = 0.001;

struct Pair {
    const ImageData& test;
    const ImageData& reference;
    double exposure;
    const std::vector<bool>& mask;
    const FlipOptions& viewer;
    bool displayed;

    bool counts(std::size_t pixel) const { return mask.empty() || mask[pixel]; }
    std::size_t channels() const { return static_cast<std::size_t>(test.channels); }
    std::span<const float> x(std::size_t pixel) const { return {test.values.data() + pixel * channels(), channels()}; }
    std::span<const float> r(std::size_t pixel) const { return {reference.values.data() + pixel * channels(), channels()}; }
};

double meanOf(std::span<const float> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}
double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}
double square(double value) { return value * value; }

/// Errors of single values, averaged over the channels of each pixel.
template <double (*error)(double x, double r, double exposure)> std::vector<double> byChannel(const Pair& pair) {
    std::vector<double> errors(pair.test.pixelCount());
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const auto x = pair.x(i), r = pair.r(i);
        for (std::size_t c = 0; c < x.size(); ++c) errors[i] += error(x[c], r[c], pair.exposure) / static_cast<double>(x.size());
    }
    return errors;
}

double squared(double x, double r, double) { return square(x - r); }
double absolute(double x, double r, double) { return std::abs(x - r); }
double absolutePercentage(double x, double r, double exposure) {
    return 100 * exposure * std::abs(x - r) / (exposure * std::abs(r) + epsilon);
}
double symmetric(double x, double r, double exposure) {
    return exposure * std::abs(x - r) / (exposure * (std::abs(x) + std::abs(r)) + epsilon);
}
double squaredDisplayed(double x, double r, double) {
    const auto displayed = [](double value) {
        return encodeSrgb(static_cast<float>(std::isnan(value) ? value : std::clamp(value, 0.0, 1.0)));
    };
    return square(static_cast<double>(displayed(x)) - static_cast<double>(displayed(r)));
}

/// The denominator is that of the whole pixel, so that a saturated red is not judged by its missing blue.
std::vector<double> relativeSquared(const Pair& pair) {
    std::vector<double> errors = byChannel<squared>(pair);
    for (std::size_t i = 0; i < errors.size(); ++i) {
        errors[i] *= square(pair.exposure) / (square(pair.exposure * meanOf(pair.r(i))) + epsilon);
    }
    return errors;
}

std::vector<double> relativeDifference(const Pair& pair) {
    double sum = 0, pixels = 0;
    for (std::size_t i = 0; i < pair.test.pixelCount(); ++i)
        if (pair.counts(i)) sum += meanOf(pair.r(i)), ++pixels;
    const double scale = pixels / sum;
    std::vector<double> differences(pair.test.pixelCount());
    for (std::size_t i = 0; i < differences.size(); ++i) differences[i] = (meanOf(pair.x(i)) - meanOf(pair.r(i))) * scale;
    return differences;
}

std::vector<double> flipDisplayed(const Pair& pair) { return flipLdr(pair.test, pair.reference, pair.viewer); }
std::vector<double> flip(const Pair& pair) {
    return pair.displayed ? flipDisplayed(pair) : flipHdr(pair.test, pair.reference, pair.viewer);
}

std::vector<double> dissimilarity(const Pair& pair) {
    std::vector<double> errors = ssimMap(Luma(pair.test, pair.exposure), Luma(pair.reference, pair.exposure));
    for (double& error : errors) error = 1 - error;
    return errors;
}
std::vector<double> gradientDissimilarity(const Pair& pair) {
    std::vector<double> errors = gradientSimilarity(Luma(pair.test, pair.exposure), Luma(pair.reference, pair.exposure));
    for (double& error : errors) error = 1 - error;
    return errors;
}
double similarityOfScales(const Pair& pair) {
    return msSsim(Luma(pair.test, pair.exposure), Luma(pair.reference, pair.exposure), pair.mask);
}

/// Which of the errors a trimmed mean is taken of; all where one is NaN, because a broken pixel is no outlier.
std::vector<bool> trimmed(const std::vector<double>& errors) {
    std::vector<bool> kept(errors.size(), true);
    if (std::ranges::any_of(errors, [](double error) { return std::isnan(error); })) return kept;
    std::vector<std::size_t> places(errors.size());
    std::iota(places.begin(), places.end(), std::size_t(0));
    const auto first = places.end() - static_cast<std::ptrdiff_t>(trimmedShare * static_cast<double>(errors.size()));
    std::ranges::nth_element(places, first, {}, [&](std::size_t place) { return std::pair(errors[place], place); });
    for (auto place = first; place != places.end(); ++place) kept[*place] = false;
    return kept;
}
double trimmedMean(const std::vector<double>& errors) {
    const std::vector<bool> kept = trimmed(errors);
    std::vector<double> rest;
    for (std::size_t i = 0; i < errors.size(); ++i)
        if (kept[i]) rest.push_back(errors[i]);
    return mean(rest);
}

double rootMean(const std::vector<double>& errors) { return std::sqrt(mean(errors)); }
double decibels(const std::vector<double>& errors) { return -10 * std::log10(mean(errors)); }
double deviation(const std::vector<double>& errors) {
    const double middle = mean(errors);
    double sum = 0;
    for (const double error : errors) sum += square(error - middle);
    return std::sqrt(sum / static_cast<double>(errors.size()));
}
double oneMinusMean(const std::vector<double>& errors) { return 1 - mean(errors); }

struct Metric {
    const char* name;
    const char* about;
    MetricScale scale;
    std::vector<double> (*map)(const Pair& pair);
    double (*pool)(const std::vector<double>& errors);
    int margin = 0;                               ///< pixels nearer to the border are not pooled
    double (*whole)(const Pair& pair) = nullptr;  ///< the value, of a metric that has neither map nor pool
};

constexpr Metric table[] = {
    {"mse", "mean of (x - r)^2 over pixels and channels, linear values", {"radiance²"}, byChannel<squared>, mean},
    {"rmse", "square root of mse", {"radiance"}, byChannel<squared>, rootMean},
    {"relmse",
     "mean over pixels of (x - r)^2, averaged over channels, / (mean(r)^2 + 0.01), mean(r) over the pixel's channels; "
     "both images scaled first so that the median luminance of r is 0.18", {},
     relativeSquared, mean},
    {"relmse_trimmed", "relmse without the 0.1 % of pixels whose errors are largest (rounded down); stands beside relmse, not in its place", {},
     relativeSquared, trimmedMean},
    {"mae", "mean of |x - r| over pixels and channels, linear values", {"radiance"}, byChannel<absolute>, mean},
    {"mape", "mean of 100 |x - r| / (|r| + 0.01) over pixels and channels, percent; images scaled as for relmse", {"%"},
     byChannel<absolutePercentage>, mean},
    {"smape", "mean of |x - r| / (|x| + |r| + 0.01) over pixels and channels, 0 to 1; images scaled as for relmse", {}, byChannel<symmetric>,
     mean},
    {"bias", "mean(x) / mean(r) - 1 over pixels and channels; positive where x is too bright", {.fromZero = false}, relativeDifference, mean},
    {"mse_display", "mse of the images as displayed (clamped to [0, 1], sRGB-encoded, peak 1)", {}, byChannel<squaredDisplayed>, mean},
    {"psnr", "-10 log10 of the mse of the images as displayed (clamped to [0, 1], sRGB-encoded, peak 1), dB; infinite for equal images", {"dB", false},
     byChannel<squaredDisplayed>, decibels},
    {"flip",
     "mean of HDR-FLIP (Andersson et al. 2021), 0 to 1: each pixel's largest LDR-FLIP error over exposures, ACES-tone-mapped, from that "
     "which shows the brightest pixel of r at 0.85 of white to that which shows the median luminance so (of the pixels above 0 where it is "
     "0), as many as stops between; of pictures as displayed (PNG, JPEG) flip_ldr; 67 pixels per degree", {},
     flip, mean},
    {"flip_ldr",
     "mean of LDR-FLIP (Andersson et al. 2020), 0 to 1, of the images as displayed (clamped to [0, 1], sRGB-encoded); 67 pixels per degree", {},
     flipDisplayed, mean},
    {"ssim",
     "mean of SSIM (Wang et al. 2004) over pixels 5 and more from the border, 1 for equal images: Gaussian window of 11 x 11 pixels, sigma "
     "1.5, C1 = 1e-4, C2 = 9e-4, on the Rec. 709 luma of the images scaled as for relmse, ACES-tone-mapped and sRGB-encoded; NaN below 11 "
     "pixels a side", {.fromZero = false},
     dissimilarity, oneMinusMean, ssimMargin},
    {"gmsd",
     "gradient magnitude similarity deviation (Xue et al. 2014), 0 for equal images: standard deviation over pixels of (2 gx gr + c) / "
     "(gx^2 + gr^2 + c), g being Prewitt gradients of means of 2 x 2 pixels of the luma of ssim, c = 0.0026; an error that is the same "
     "everywhere has 0", {},
     gradientDissimilarity, deviation},
    {"ms_ssim",
     "MS-SSIM (Wang et al. 2003), 1 for equal images: as ssim, on five scales; below 176 pixels a side on those of 11 pixels and more, "
     "their powers scaled to the same sum, so that only values of one size compare; NaN below 11", {.fromZero = false},
     nullptr, nullptr, 0, similarityOfScales},
};

const Metric& metricNamed(std::string_view name) {
    const auto found = std::ranges::find(table, name, [](const Metric& metric) { return std::string_view(metric.name); });
    if (found == std::end(table)) throw Error("unknown metric \"" + std::string(name) + "\"", didYouMean(name, metricNames()));
    return *found;
}

std::string shape(const ImageData& image) {
    return std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels of " + std::to_string(image.channels) +
           " channels";
}

/// Refers to the arguments.
Pair pairOf(const ImageData& test, const ImageData& reference, const MetricOptions& options) {
    if (test.width != reference.width || test.height != reference.height || test.channels != reference.channels) {
        throw Error("the images cannot be compared: the test has " + shape(test) + ", the reference " + shape(reference));
    }
    if (test.values.empty()) throw Error("the images cannot be compared: they have no pixels");
    if (!options.mask.empty() && options.mask.size() != test.pixelCount())
        throw Error("the mask has " + std::to_string(options.mask.size()) + " pixels, the images " + std::to_string(test.pixelCount()));
    if (!options.mask.empty() && std::ranges::find(options.mask, true) == options.mask.end()) throw Error("the mask leaves no pixel");
    return {test, reference, options.exposure ? *options.exposure : exposureOf(reference), options.mask, options.flip, options.displayed};
}

}  // namespace

double exposureOf(const ImageData& reference) {
    const auto channels = static_cast<std::size_t>(reference.channels);
    std::vector<double> luminances;
    for (std::size_t i = 0; i < reference.pixelCount(); ++i) {
        const std::span r(reference.values.data() + i * channels, channels);
        const double luminance = channels >= 3 ? 0.2126 * r[0] + 0.7152 * r[1] + 0.0722 * r[2] : meanOf(r);
        if (luminance > 0 && std::isfinite(luminance)) luminances.push_back(luminance);
    }
    if (luminances.empty()) return 1;
    const auto median = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
    std::ranges::nth_element(luminances, median);
    return 0.18 / *median;
}

std::vector<std::string> metricNames() {
    std::vector<std::string> names;
    for (const Metric& metric : table) names.emplace_back(metric.name);
    return names;
}

MetricScale scaleOf(std::string_view name) {
    const auto found = std::ranges::find(table, name, [](const Metric& metric) { return std::string_view(metric.name); });
    return found == std::end(table) ? MetricScale{} : found->scale;
}

std::string metricAbout(std::string_view name) { return metricNamed(name).about; }

std::map<std::string, double> evaluateAll(const std::vector<std::string>& names, const ImageData& test, const ImageData& reference,
                                          const MetricOptions& options) {
    const Pair pair = pairOf(test, reference, options);
    std::map<decltype(Metric::map), std::vector<double>> maps;
    std::map<std::string, double> values;
    for (const std::string& name : names) {
        const Metric& metric = metricNamed(name);
        if (metric.whole) {
            values[name] = metric.whole(pair);
            continue;
        }
        std::vector<double>& errors = maps[metric.map];
        if (errors.empty()) errors = metric.map(pair);
        std::vector<double> pooled;
        for (int y = metric.margin; y < test.height - metric.margin; ++y) {
            for (int x = metric.margin; x < test.width - metric.margin; ++x) {
                const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(test.width) + static_cast<std::size_t>(x);
                if (pair.counts(pixel)) pooled.push_back(errors[pixel]);
            }
        }
        values[name] = pooled.empty() ? std::numeric_limits<double>::quiet_NaN() : metric.pool(pooled);
    }
    return values;
}

double evaluate(std::string_view name, const ImageData& test, const ImageData& reference, const MetricOptions& options) {
    return evaluateAll({std::string(name)}, test, reference, options).begin()->second;
}

std::vector<bool> trimmedMask(const ImageData& test, const ImageData& reference, const MetricOptions& options) {
    const Pair pair = pairOf(test, reference, options);
    const std::vector<double> all = relativeSquared(pair);
    std::vector<double> errors;
    for (std::size_t pixel = 0; pixel < all.size(); ++pixel)
        if (pair.counts(pixel)) errors.push_back(all[pixel]);
    const std::vector<bool> kept = trimmed(errors);
    std::vector<bool> mask(all.size());
    for (std::size_t pixel = 0, place = 0; pixel < all.size(); ++pixel)
        if (pair.counts(pixel)) mask[pixel] = kept[place++];
    return mask;
}

ImageData errorMap(std::string_view name, const ImageData& test, const ImageData& reference, const MetricOptions& options) {
    const Metric& metric = metricNamed(name);
    if (!metric.map) throw Error(std::string(name) + " is not made of errors of pixels: there is no map of it", "\"ssim\" has one");
    const std::vector<double> errors = metric.map(pairOf(test, reference, options));
    ImageData map = makeImage(test.width, test.height, 1);
    std::ranges::transform(errors, map.values.begin(), [](double error) { return static_cast<float>(error); });
    return map;
}

}  // namespace lodestir
