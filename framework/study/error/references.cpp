// SPDX-License-Identifier: MIT
#include <framework/core/is_file.h>
#include <framework/image/exr.h>
#include <framework/image/metrics.h>
#include <framework/study/error/references.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

Halves loadHalves(Stage& stage, const std::array<ReferenceHalf, 2>& halves) {
    for (const ReferenceHalf& half : halves)
        if (!isFile(half.file)) stage.makeHalf(half);
    return {readExr(halves[0].file), readExr(halves[1].file)};
}

/// Where the image isn't 0.
std::vector<bool> pixelsOf(const ImageData& image, const Study& study, std::size_t scene, const Mask& mask) {
    std::vector<bool> pixels;
    for (std::size_t i = 0; i < image.pixelCount(); ++i) pixels.push_back(image.values[i * std::size_t(image.channels)] != 0);
    if (std::ranges::find(pixels, true) == pixels.end())
        throw Error(mask.graph->where, fmt::format("the mask \"{}\" is empty in scene {}", mask.name, study.scenes[scene].name));
    return pixels;
}

}  // namespace

std::vector<ReferenceHalf> missingHalves(Stage& stage, const Study& study, std::size_t scene, const Path& folder) {
    std::vector<ReferenceHalf> missing;
    for (const int offset : study.measure)
        for (const bool finest : {false, true}) {
            if (finest && !study.referenceFinest) continue;
            for (const ReferenceHalf& half : stage.referenceHalves(scene, offset, folder, finest))
                if (!isFile(half.file) && std::ranges::find(missing, half.file, &ReferenceHalf::file) == missing.end()) missing.push_back(half);
        }
    return missing;
}

SceneReferences loadReferences(Stage& stage, const Study& study, std::size_t scene, const Path& folder) {
    SceneReferences references{.scene = scene};
    if (needsSeen(study)) {
        Seen seen = stage.see(scene);
        for (const Mask& mask : study.masks)
            if (!mask.graph)
                if (auto masks = switchedMasks(seen, study, study.scenes[scene], mask.optional); !masks.empty()) references.masks[mask.name] = std::move(masks);
        references.motions = std::move(seen.motions);
    }
    for (const Mask& mask : study.masks)
        if (mask.graph)
            for (const ImageData& image : stage.renderMask(*mask.graph, scene)) references.masks[mask.name].push_back(pixelsOf(image, study, scene, mask));
    for (const int offset : study.measure) {
        references.frames.push_back(loadHalves(stage, stage.referenceHalves(scene, offset, folder, false)));
        if (study.referenceFinest) references.finest.push_back(loadHalves(stage, stage.referenceHalves(scene, offset, folder, true)));
    }
    references.exposure = exposureOf(references.frames.front().mean);
    references.flipExposures = flipExposures(references.frames.front().mean);
    for (const auto* list : {&references.frames, &references.finest})
        for (const Halves& halves : *list)
            for (const float value : halves.mean.values)
                if (!std::isfinite(value))
                    throw Error("the reference of scene " + study.scenes[scene].name + " holds values that are not finite");
    return references;
}

}  // namespace lodestir
