// SPDX-License-Identifier: MIT
#include <framework/scene/panes.h>
#include <framework/scene/upload/scene_facts.h>

#include <algorithm>

namespace lodestir {

std::vector<std::pair<std::string, std::string>> sceneFacts(const Scene& scene) {
    const auto any = [&](const auto& has) { return std::ranges::any_of(scene.materials, has) ? "1" : "0"; };
    const auto isLight = [&](std::uint32_t material) { return scene.materials[material].isLight(); };
    const auto glowsAtSeveralLevels = [&](const Mesh& mesh) { return mesh.levels.size() > 1 && std::ranges::any_of(mesh.levels[0].materials, isLight); };
    return {{"SCENE_LAYERS", any([](const Material& m) { return m.layers.has_value(); })},
            {"SCENE_MASKS", any([](const Material& m) { return m.alphaMode == AlphaMode::mask; })},
            {"SCENE_PANES", lightsShineThroughPanes(scene) ? "1" : "0"},
            {"SCENE_LIGHT_LEVELS", std::ranges::any_of(scene.meshes, glowsAtSeveralLevels) ? "1" : "0"}};
}

}  // namespace lodestir
