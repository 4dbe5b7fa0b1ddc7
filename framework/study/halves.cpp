// SPDX-License-Identifier: MIT
#include <framework/core/error.h>
#include <framework/study/halves.h>

#include <utility>

namespace lodestir {

Halves::Halves(ImageData first, ImageData second) : a(std::move(first)), b(std::move(second)), mean(a) {
    if (a.width != b.width || a.height != b.height || a.channels != b.channels) throw Error("the halves of a reference differ in size");
    for (std::size_t i = 0; i < mean.values.size(); ++i) mean.values[i] = 0.5f * (a.values[i] + b.values[i]);
}

bool isNoiseFree(std::string_view metric) { return metric == "mse" || metric == "relmse"; }

double measureError(std::string_view metric, const ImageData& test, const Halves& reference, const MetricOptions& options) {
    return evaluate(metric, test, reference.mean, options) - referenceNoise(metric, reference, options);
}

double referenceNoise(std::string_view metric, const Halves& reference, const MetricOptions& options) {
    return isNoiseFree(metric) ? evaluate(metric, reference.a, reference.mean, options) : 0;
}

}  // namespace lodestir
