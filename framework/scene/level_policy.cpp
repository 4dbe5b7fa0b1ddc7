// SPDX-License-Identifier: MIT
#include <framework/scene/level_policy.h>

#include <algorithm>

namespace lodestir {

std::vector<std::uint32_t> levelsAt(const Scene& scene, float frame) {
    if (scene.lod.mode == LodMode::schedule) return scheduledLevels(scene, frame);
    return std::vector<std::uint32_t>(scene.instances.size(), 0);
}

std::vector<std::uint32_t> scheduledLevels(const Scene& scene, float frame) {
    std::vector<std::uint32_t> levels(scene.instances.size(), 0);
    std::vector<LodSwitch> switches = scene.lod.schedule;
    std::ranges::stable_sort(switches, {}, &LodSwitch::frame);
    for (const LodSwitch& s : switches) {
        if (float(s.frame) > frame) break;
        for (std::size_t i = 0; i < levels.size(); ++i) {
            if (s.instance != none && s.instance != i) continue;
            const auto coarsest = std::uint32_t(scene.meshes[scene.instances[i].mesh].levels.size() - 1);
            levels[i] = std::min(std::uint32_t(std::max(s.level, 0)), coarsest);
        }
    }
    return levels;
}

std::vector<std::uint32_t> instancesNamed(const Scene& scene, const std::string& name) {
    std::vector<std::uint32_t> named, below;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        if (scene.instances[i].name == name) named.push_back(i);
        std::uint32_t node = scene.instances[i].node;
        while (node != none && scene.nodes[node].name != name) node = scene.nodes[node].parent;
        if (node != none) below.push_back(i);
    }
    return named.empty() ? below : named;
}

std::string describe(const LodPolicy& policy) {
    switch (policy.mode) {
        case LodMode::finest: return "finest level of every instance";
        case LodMode::schedule: return "schedule with " + std::to_string(policy.schedule.size()) + " switches";
        case LodMode::screenError: return "screen_error, which needs a pass that selects levels: the finest level is shown";
        case LodMode::distance: return "distance, which needs a pass that selects levels: the finest level is shown";
        case LodMode::stochastic: return "stochastic, which needs a pass that selects levels: the finest level is shown";
    }
    return {};
}

}  // namespace lodestir
