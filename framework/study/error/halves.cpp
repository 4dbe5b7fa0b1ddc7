// SPDX-License-Identifier: MIT
#include <framework/core/error.h>
#include <framework/study/error/halves.h>

#include <cmath>
#include <utility>

namespace lodestir {

Halves::Halves(ImageData first, ImageData second) : a(std::move(first)), b(std::move(second)), mean(a) {
    if (a.width != b.width || a.height != b.height || a.channels != b.channels) throw Error("the halves of a reference differ in size");
    for (std::size_t i = 0; i < mean.values.size(); ++i) mean.values[i] = 0.5f * (a.values[i] + b.values[i]);
}

bool isNoiseFree(std::string_view metric) { return metric == "mse" || metric == "relmse" || metric == "relmse_trimmed"; }

double measureError(std::string_view metric, const ImageData& test, const Halves& reference, const MetricOptions& options) {
    return evaluate(metric, test, reference.mean, options) - referenceNoise(metric, test, reference, options);
}

double referenceNoise(std::string_view metric, const ImageData& test, const Halves& reference, const MetricOptions& options) {
    if (!isNoiseFree(metric)) return 0;
    if (metric != "relmse_trimmed") return evaluate(metric, reference.a, reference.mean, options);
    MetricOptions kept = options;
    kept.mask = trimmedMask(test, reference.mean, options);
    return evaluate("relmse", reference.a, reference.mean, kept);
}

double referenceDeviation(std::string_view metric, const Halves& reference, const MetricOptions& options) {
    if (metric != "bias") return 0;
    // Of the mean of (A + B) / 2: its variance in a pixel is expected to be ((A - B) / 2)^2.
    const auto channels = std::size_t(reference.mean.channels);
    double squares = 0, sum = 0;
    for (std::size_t pixel = 0; pixel < reference.mean.pixelCount(); ++pixel) {
        if (!options.mask.empty() && !options.mask[pixel]) continue;
        double half = 0;
        for (std::size_t i = pixel * channels; i < (pixel + 1) * channels; ++i) {
            half += 0.5 * (double(reference.a.values[i]) - double(reference.b.values[i]));
            sum += double(reference.mean.values[i]);
        }
        squares += half * half;
    }
    return std::sqrt(squares) / std::abs(sum);
}

}  // namespace lodestir
