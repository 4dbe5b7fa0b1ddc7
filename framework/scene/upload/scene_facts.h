// SPDX-License-Identifier: MIT
// What the materials and levels of a scene ask of shaders: shaders/world/scene_facts.glsl.
#pragma once
#include <framework/scene/scene.h>

#include <string>
#include <utility>
#include <vector>

namespace lodestir {

/// The defines, "1" or "0", with which shaders are compiled for the scene.
std::vector<std::pair<std::string, std::string>> sceneFacts(const Scene& scene);

}  // namespace lodestir
