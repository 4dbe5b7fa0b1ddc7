// SPDX-License-Identifier: MIT
#include <framework/scene/panes.h>
#include <framework/scene/upload/scene_facts.h>

#include <algorithm>

namespace lodestir {

std::vector<std::pair<std::string, std::string>> sceneFacts(const Scene& scene) {
    const auto any = [&](const auto& has) { return std::ranges::any_of(scene.materials, has) ? "1" : "0"; };
    return {{"SCENE_LAYERS", any([](const Material& m) { return m.layers.has_value(); })},
            {"SCENE_MASKS", any([](const Material& m) { return m.alphaMode == AlphaMode::mask; })},
            {"SCENE_PANES", lightsShineThroughPanes(scene) ? "1" : "0"}};
}

}  // namespace lodestir
