// SPDX-License-Identifier: MIT
#include <framework/study/error/decomposition.h>

#include <numeric>

namespace lodestir {
namespace {

/// What the runs say whose errors and sum of images these are.
struct Parts {
    double bias, variance;
    Parts(const std::vector<double>& errors, double errorOfMean) {
        const auto n = double(errors.size());
        const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / n;
        variance = (mean - errorOfMean) * n / (n - 1);
        bias = mean - variance;
    }
};

}  // namespace

bool isDecomposed(std::string_view metric) { return metric == "mse" || metric == "relmse"; }

Decomposition decompose(std::string_view metric, const std::vector<ImageData>& runs, const Halves& reference, const MetricOptions& options) {
    std::vector<double> sum(reference.mean.values.size()), errors;
    for (const ImageData& run : runs) {
        errors.push_back(measureError(metric, run, reference, options));
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += double(run.values[i]);
    }
    /// The error of the mean image of all runs but one; `left` as many as there are: of all.
    const auto errorWithout = [&](std::size_t left) {
        ImageData mean = reference.mean;
        const double count = double(runs.size()) - (left < runs.size() ? 1 : 0);
        for (std::size_t i = 0; i < sum.size(); ++i) mean.values[i] = float((sum[i] - (left < runs.size() ? double(runs[left].values[i]) : 0)) / count);
        return measureError(metric, mean, reference, options);
    };
    const Parts whole(errors, errorWithout(runs.size()));
    std::vector<double> biases, variances;
    for (std::size_t i = 0; runs.size() > 2 && i < runs.size(); ++i) {
        std::vector<double> others = errors;
        others.erase(others.begin() + std::ptrdiff_t(i));
        const Parts parts(others, errorWithout(i));
        biases.push_back(parts.bias);
        variances.push_back(parts.variance);
    }
    return {.cell = 0, .metric = std::string(metric), .bias = estimateJackknife(whole.bias, biases), .variance = estimateJackknife(whole.variance, variances)};
}

}  // namespace lodestir
