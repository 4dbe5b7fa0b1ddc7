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

}  // namespace

void keepChunkImage(const Path& folder, const std::string& chunk, int offset, const ImageData& image, int runs) {
    writeExr(fileOf(folder, chunk, offset), image, {.channels = chunkChannels, .attributes = {{"runs", std::to_string(runs)}}});
}

double EnsembleImage::luminance(std::size_t pixel) const {
    const float* c = &image.values[4 * pixel];
    return 0.2126 * double(c[0]) + 0.7152 * double(c[1]) + 0.0722 * double(c[2]);
}

double EnsembleImage::variance(std::size_t pixel) const {
    const double mean = luminance(pixel);
    // Squares in 32 bits hold the variance of nearly equal values to no more than this.
    const double floor = 1e-6 * mean * mean;
    return std::max(double(image.values[4 * pixel + 3]) - mean * mean, floor) / std::max(1.0, runs - 1);
}

std::vector<EnsembleImage> readChunkImages(const Path& folder, const std::vector<std::string>& chunks, int offset) {
    std::vector<EnsembleImage> images;
    for (const std::string& chunk : chunks) {
        const ExrFile file = readExrChannels(fileOf(folder, chunk, offset), chunkChannels);
        const auto runs = file.attributes.find("runs");
        if (runs == file.attributes.end()) throw Error({fileOf(folder, chunk, offset).string()}, "is no image of a chunk of runs");
        images.push_back({file.image, std::stod(runs->second)});
    }
    return images;
}

EnsembleImage joinImages(std::span<const EnsembleImage> images) {
    EnsembleImage whole{.image = images.front().image};
    std::vector<double> sum(whole.image.values.size());
    for (const EnsembleImage& part : images) {
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part.runs * double(part.image.values[i]);
        whole.runs += part.runs;
    }
    std::ranges::transform(sum, whole.image.values.begin(), [&](double value) { return float(value / whole.runs); });
    return whole;
}

ImageData sigmaMap(const EnsembleImage& runs, const EnsembleImage& reference) {
    ImageData map = makeImage(runs.image.width, runs.image.height, 1);
    for (std::size_t p = 0; p < map.pixelCount(); ++p) {
        const double variance = runs.variance(p) + reference.variance(p), difference = runs.luminance(p) - reference.luminance(p);
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
