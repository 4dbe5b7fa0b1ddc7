// SPDX-License-Identifier: MIT
// A reference whose own noise is known, because it was rendered twice.
#pragma once
#include <framework/image/image.h>
#include <framework/image/metrics.h>

#include <string_view>

namespace lodestir {

/// Two independent, equally good estimates A and B of one image, and their mean M. Three channels.
struct Halves {
    Halves(ImageData first, ImageData second);
    ImageData a, b, mean;
};

/// Whether measureError() takes the reference's noise out of a metric.
bool isNoiseFree(std::string_view metric);

/// The error of `test` (three channels). For "mse" and "relmse" it is the mean of (x - A)(x - B), weighted as the metric weighs (x - M)^2: unbiased for
/// mse, and for relmse up to the noise of M in the denominator; it may come out negative where the error is far below the reference's noise. As
/// (x - A)(x - B) = (x - M)^2 - (A - M)^2, it is evaluate(x, M) - evaluate(A, M). "relmse_trimmed" is that of relmse at the pixels that it keeps of x and M;
/// choosing them by M takes out a little too much: of Gaussian noise everywhere, 0.5 % of the noise. (A choice by A or B would be no better: the error
/// at what it keeps would need two halves that had no part in it.) Other metrics are evaluate(x, M), noise of M included.
/// `options`: its exposure has to be set, one for all that is compared.
double measureError(std::string_view metric, const ImageData& test, const Halves& reference, const MetricOptions& options);

/// Standard deviation that the reference's noise gives the value of a metric in all runs alike, which no spread over seeds shows: of "bias", by
/// the differences of A and B, pixels being independent; 0 for other metrics.
double referenceDeviation(std::string_view metric, const Halves& reference, const MetricOptions& options);

/// What measureError() takes out, an unbiased estimate of the error of M itself where the metric counts; 0 for metrics that keep it.
double referenceNoise(std::string_view metric, const ImageData& test, const Halves& reference, const MetricOptions& options);

}  // namespace lodestir
