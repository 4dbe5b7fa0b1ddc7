// SPDX-License-Identifier: MIT
// How far an image is from a reference, in numbers and per pixel. Definitions stand in the table of metrics.cpp and in metricAbout().
#pragma once
#include <framework/image/flip.h>
#include <framework/image/image.h>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lodestir {

struct MetricOptions {
    /// Factor on both images before an epsilon is added or SSIM's tone curve applied, for the metrics that have one: they suit one brightness.
    /// Unset, it is exposureOf(reference). The frames of a sequence need one value for all to be comparable.
    std::optional<double> exposure{};
    /// Pixels that count, row by row: those that are true. Empty: all.
    std::vector<bool> mask{};
    /// The images are pictures as displayed (linear, but of 8 or 16 bits) and no radiance: "flip" and "tflip" are LDR-FLIP, exposures unasked.
    bool displayed = false;
    /// The viewer of "flip" and "flip_ldr", and the exposures of "flip", of which a sequence needs the same for all frames, too.
    FlipOptions flip{};
};

/// The factor that brings the median luminance (Rec. 709) of the pixels above 0 to 0.18; 1 where there are none.
LODESTIR_API double exposureOf(const ImageData& reference);

LODESTIR_API std::vector<std::string> metricNames();
/// What a chart has to know of a metric.
struct MetricScale {
    std::string_view unit = {};
    bool fromZero = true;  ///< never negative but for noise, and smaller is better: fit for a logarithmic axis
};
/// Of any name, of which those without an entry in the table (metrics of sequences) have no unit.
LODESTIR_API MetricScale scaleOf(std::string_view name);
/// The definition in a sentence, x being the test image and r the reference. Error when there is no such metric.
LODESTIR_API std::string metricAbout(std::string_view name);

/// The value of a metric; all channels count alike, unless it judges what is seen ("flip" to "ms_ssim"): there three are red, green, blue.
/// Where a pixel that counts is NaN, so is the value; also where an image is too small for the metric ("ssim" below 11 pixels a side).
/// Throws Error when there is no such metric, the images differ in size or channels, are empty, or the mask has another size or leaves none.
LODESTIR_API double evaluate(std::string_view name, const ImageData& test, const ImageData& reference, const MetricOptions& options = {});

/// The pixels that "relmse_trimmed" is the mean of "relmse" over: those that count but for the 0.1 % (rounded down) with the largest errors.
LODESTIR_API std::vector<bool> trimmedMask(const ImageData& test, const ImageData& reference, const MetricOptions& options = {});

/// The same of several metrics by name; what they share is computed once.
LODESTIR_API std::map<std::string, double> evaluateAll(const std::vector<std::string>& names, const ImageData& test,
                                                       const ImageData& reference, const MetricOptions& options = {});

/// The error of each pixel (one channel), in the mask or not: what the metric is made of, before roots or logarithms. For "ssim" it is
/// 1 - SSIM, 0 near the border; for "gmsd" 1 - similarity. Throws as evaluate() does, and where the metric is not made of pixels ("ms_ssim").
LODESTIR_API ImageData errorMap(std::string_view name, const ImageData& test, const ImageData& reference,
                                const MetricOptions& options = {});

}  // namespace lodestir
