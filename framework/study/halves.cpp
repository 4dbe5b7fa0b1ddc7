// SPDX-License-Identifier: MIT
#include <framework/core/error.h>
#include <framework/image/metrics.h>
#include <framework/study/halves.h>

#include <utility>

namespace lodestir {

Halves::Halves(ImageData first, ImageData second) : a(std::move(first)), b(std::move(second)), mean(a) {
    if (a.width != b.width || a.height != b.height || a.channels != b.channels) throw Error("the halves of a reference differ in size");
    for (std::size_t i = 0; i < mean.values.size(); ++i) mean.values[i] = 0.5f * (a.values[i] + b.values[i]);
}

bool isNoiseFree(std::string_view metric) { return metric == "mse" || metric == "relmse"; }

double measureError(std::string_view metric, const ImageData& test, const Halves& reference, double exposure) {
    return evaluate(metric, test, reference.mean, {.exposure = exposure}) - referenceNoise(metric, reference, exposure);
}

double referenceNoise(std::string_view metric, const Halves& reference, double exposure) {
    return isNoiseFree(metric) ? evaluate(metric, reference.a, reference.mean, {.exposure = exposure}) : 0;
}

}  // namespace lodestir
