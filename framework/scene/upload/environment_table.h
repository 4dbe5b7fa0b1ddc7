// SPDX-License-Identifier: MIT
// The environment map as shaders read it: radiance, and an alias table that picks texels by the light they send.
#pragma once
#include <framework/scene/scene.h>
#include <framework/shaders/world/world.h>

#include <vector>

namespace lodestir {

/// One entry a texel. The weight of a texel is its solid angle times the luminance of the 3x3 texels around it under a tent filter:
/// radiance is interpolated between texels when it is read, so a dark neighbour of a bright texel sends light too.
std::vector<EnvironmentTexel> environmentTable(const Environment& environment);

}  // namespace lodestir
