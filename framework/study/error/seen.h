// SPDX-License-Identifier: MIT
// Where objects are seen that take another level: the mask "switched" of studies.
#pragma once
#include <framework/graph/runner.h>
#include <framework/scene/scene.h>
#include <framework/study/study_file.h>

#include <vector>

namespace lodestir {

/// What the frames of a study are rendered from and on.
struct MaskStage {
    const Study& study;
    const StudyScene& file;
    const Scene& scene;
    PluginLibraries& libraries;
    const gpu::Device& device;
    RayBody rays;
};

/// Of each measured frame, the pixels whose centres see an object that takes another level at the event or later, up to the last
/// measured frame, by the scene's own policy. Error when there is none.
std::vector<std::vector<bool>> switchedMasks(const MaskStage& stage);

}  // namespace lodestir
