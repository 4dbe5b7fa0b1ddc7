// SPDX-License-Identifier: MIT
// A study of what a viewer compares: its two sides as techniques, what they see as the scene, and a path tracer as the reference.
#pragma once
#include <framework/app/view/live_side.h>

namespace lodestir {

struct ComparedSetting {
    const SideGraph* a;               ///< null: there is none
    const SideGraph& b;
    Path scene;
    std::optional<CameraKey> camera;  ///< in place of the scene's
    glm::uvec2 size;
    std::uint32_t frame, framesStill;  ///< that is shown, and how many lie behind it since anything was changed
    std::vector<Path> passes;          ///< extra folders of pass libraries
};

/// Writes it and what it needs into `folder`; returns the study file. A graph that its file, variant and parameters don't make is written beside it, as is
/// a scene that is seen through another camera.
Path writeSideStudy(const ComparedSetting& setting, const Path& folder);

}  // namespace lodestir
