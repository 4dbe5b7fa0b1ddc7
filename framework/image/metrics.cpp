// SPDX-License-Identifier: MIT
// Error metrics. A new one is a line in the table: its name, its definition, the error of each pixel, and how pixels become one value.
#include <framework/core/error.h>
#include <framework/image/metrics.h>
#include <framework/image/srgb.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <span>

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

double trimmedMean(const std::vector<double>& errors) {
    if (std::ranges::any_of(errors, [](double error) { return std::isnan(error); })) return std::nan("");  // a broken pixel is no outlier
    std::vector<double> kept = errors;
    const auto dropped = static_cast<std::ptrdiff_t>(trimmedShare * static_cast<double>(kept.size()));
    std::ranges::nth_element(kept, kept.end() - dropped - 1);
    kept.erase(kept.end() - dropped, kept.end());
    return mean(kept);
}

double rootMean(const std::vector<double>& errors) { return std::sqrt(mean(errors)); }
double decibels(const std::vector<double>& errors) { return -10 * std::log10(mean(errors)); }

struct Metric {
    const char* name;
    const char* about;
    std::vector<double> (*map)(const Pair& pair);
    double (*pool)(const std::vector<double>& errors);
};

constexpr Metric table[] = {
    {"mse", "mean of (x - r)^2 over pixels and channels, linear values", byChannel<squared>, mean},
    {"rmse", "square root of mse", byChannel<squared>, rootMean},
    {"relmse",
     "mean over pixels of (x - r)^2, averaged over channels, / (mean(r)^2 + 0.01), mean(r) over the pixel's channels; "
     "both images scaled first so that the median luminance of r is 0.18",
     relativeSquared, mean},
    {"relmse_trimmed", "relmse without the 0.1 % of pixels whose errors are largest (rounded down); stands beside relmse, not in its place",
     relativeSquared, trimmedMean},
    {"mae", "mean of |x - r| over pixels and channels, linear values", byChannel<absolute>, mean},
    {"mape", "mean of 100 |x - r| / (|r| + 0.01) over pixels and channels, percent; images scaled as for relmse",
     byChannel<absolutePercentage>, mean},
    {"smape", "mean of |x - r| / (|x| + |r| + 0.01) over pixels and channels, 0 to 1; images scaled as for relmse", byChannel<symmetric>,
     mean},
    {"bias", "mean(x) / mean(r) - 1 over pixels and channels; positive where x is too bright", relativeDifference, mean},
    {"psnr", "-10 log10 of the mse of the images as displayed (clamped to [0, 1], sRGB-encoded, peak 1), dB; infinite for equal images",
     byChannel<squaredDisplayed>, decibels},
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

std::vector<double> errorsOf(const Metric& metric, const ImageData& test, const ImageData& reference, const MetricOptions& options) {
    if (test.width != reference.width || test.height != reference.height || test.channels != reference.channels) {
        throw Error("the images cannot be compared: the test has " + shape(test) + ", the reference " + shape(reference));
    }
    if (test.values.empty()) throw Error("the images cannot be compared: they have no pixels");
    if (!options.mask.empty() && options.mask.size() != test.pixelCount())
        throw Error("the mask has " + std::to_string(options.mask.size()) + " pixels, the images " + std::to_string(test.pixelCount()));
    if (!options.mask.empty() && std::ranges::find(options.mask, true) == options.mask.end()) throw Error("the mask leaves no pixel");
    return metric.map({test, reference, options.exposure ? *options.exposure : exposureOf(reference), options.mask});
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

std::string metricAbout(std::string_view name) { return metricNamed(name).about; }

double evaluate(std::string_view name, const ImageData& test, const ImageData& reference, const MetricOptions& options) {
    const Metric& metric = metricNamed(name);
    std::vector<double> errors = errorsOf(metric, test, reference, options);
    if (!options.mask.empty()) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < errors.size(); ++i)
            if (options.mask[i]) errors[kept++] = errors[i];
        errors.resize(kept);
    }
    return metric.pool(errors);
}

ImageData errorMap(std::string_view name, const ImageData& test, const ImageData& reference, const MetricOptions& options) {
    const std::vector<double> errors = errorsOf(metricNamed(name), test, reference, options);
    ImageData map = makeImage(test.width, test.height, 1);
    std::ranges::transform(errors, map.values.begin(), [](double error) { return static_cast<float>(error); });
    return map;
}

}  // namespace lodestir
