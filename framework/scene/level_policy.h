// SPDX-License-Identifier: MIT
// Which level each instance shows where no pass of the graph chooses: the scene file's own policy.
#pragma once
#include <framework/scene/scene.h>

#include <cstdint>
#include <string>
#include <vector>

namespace lodestir {

/// Level of each instance at a frame: `finest` 0, `schedule` as below. The other modes need a camera and are a pass's business: they show
/// the finest level.
LODESTIR_API std::vector<std::uint32_t> levelsAt(const Scene& scene, float frame);
/// By the scene's schedule, whatever its mode: that of the last switch at or before the frame (0 before the first), at most the mesh's
/// coarsest.
LODESTIR_API std::vector<std::uint32_t> scheduledLevels(const Scene& scene, float frame);
/// The instances of that name; where there is none, those below a node of that name.
LODESTIR_API std::vector<std::uint32_t> instancesNamed(const Scene& scene, const std::string& name);
/// The policy in words, e.g. "schedule with 3 switches".
LODESTIR_API std::string describe(const LodPolicy& policy);

}  // namespace lodestir
