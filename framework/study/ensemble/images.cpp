// SPDX-License-Identifier: MIT
#include <framework/core/error.h>
#include <framework/image/exr.h>
#include <framework/study/ensemble/images.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

const std::vector<std::string> chunkChannels{"mean.0", "mean.1", "mean.2", "square"};

Path fileOf(const Path& folder, const std::string& chunk, int offset) { return folder / fmt::format("{}.{}.exr", chunk, offset); }

double luminanceOf(const ImageData& image, std::size_t pixel) {
    const float* c = &image.values[4 * pixel];
    return 0.2126 * double(c[0]) + 0.7152 * double(c[1]) + 0.0722 * double(c[2]);
}

/// Of the mean of a pixel's luminance.
double varianceOf(const EnsembleImage& e, std::size_t pixel) {
    const double mean = luminanceOf(e.image, pixel);
    // Squares in 32 bits hold the variance of nearly equal values to no more than this.
    const double floor = 1e-6 * mean * mean;
    return std::max(double(e.image.values[4 * pixel + 3]) - mean * mean, floor) / std::max(1.0, e.runs - 1);
}

}  // namespace

void keepChunkImage(const Path& folder, const std::string& chunk, int offset, const ImageData& image, int runs) {
    writeExr(fileOf(folder, chunk, offset), image, {.channels = chunkChannels, .attributes = {{"runs", std::to_string(runs)}}});
}

EnsembleImage joinChunkImages(const Path& folder, const std::vector<std::string>& chunks, int offset) {
    EnsembleImage whole;
    std::vector<double> sum;
    for (const std::string& chunk : chunks) {
        const ExrFile file = readExrChannels(fileOf(folder, chunk, offset), chunkChannels);
        const auto runs = file.attributes.find("runs");
        if (runs == file.attributes.end()) throw Error({fileOf(folder, chunk, offset).string()}, "is no image of a chunk of runs");
        const double count = std::stod(runs->second);
        sum.resize(file.image.values.size());
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += count * double(file.image.values[i]);
        whole.runs += count;
        whole.image = file.image;
    }
    std::ranges::transform(sum, whole.image.values.begin(), [&](double value) { return float(value / whole.runs); });
    return whole;
}

ImageData sigmaMap(const EnsembleImage& runs, const EnsembleImage& reference) {
    ImageData map = makeImage(runs.image.width, runs.image.height, 1);
    for (std::size_t p = 0; p < map.pixelCount(); ++p) {
        const double variance = varianceOf(runs, p) + varianceOf(reference, p),
                     difference = luminanceOf(runs.image, p) - luminanceOf(reference.image, p);
        map.values[p] = difference == 0 ? 0.0f : float(difference / std::sqrt(variance));
    }
    return map;
}

ImageData divergingMap(const ImageData& values, double top) {
    ImageData map = makeImage(values.width, values.height, 3);
    for (std::size_t p = 0; p < map.pixelCount(); ++p) {
        const float z = values.values[p * std::size_t(values.channels)], fade = 1 - std::min(1.0f, std::abs(z) / float(top));
        float* c = &map.values[3 * p];
        if (std::isnan(z))
            c[1] = 1;
        else
            c[0] = z > 0 ? 1 : fade, c[1] = fade, c[2] = z < 0 ? 1 : fade;
    }
    return map;
}

}  // namespace lodestir
