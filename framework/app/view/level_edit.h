// SPDX-License-Identifier: MIT
// Levels of detail forced by hand: what the parameter of lod_select becomes. Pure functions; no window, no GPU.
#pragma once
#include <framework/scene/forced_levels.h>

#include <span>

namespace lodestir {

/// With one instance at a level, or as the policy has it (no level).
LODESTIR_API std::vector<ForcedLevel> withForced(const Scene& scene, std::vector<ForcedLevel> forced, std::uint32_t instance, std::optional<int> level);
/// With all instances a step finer (below 0) or coarser than now, as far as their meshes have levels.
LODESTIR_API std::vector<ForcedLevel> withAllMoved(const Scene& scene, std::span<const std::uint32_t> now, int step);

}  // namespace lodestir
