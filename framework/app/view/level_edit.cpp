// SPDX-License-Identifier: MIT
#include <framework/app/view/level_edit.h>

#include <algorithm>
#include <array>

namespace lodestir {

std::uint32_t levelsToChoose(const Scene& scene, const Mesh& mesh) {
    const auto isLight = [&](std::uint32_t material) { return scene.materials[material].isLight(); };
    return std::ranges::any_of(mesh.levels[0].materials, isLight) ? 1 : std::uint32_t(mesh.levels.size());
}

std::vector<ForcedLevel> withForced(const Scene& scene, std::vector<ForcedLevel> forced, std::uint32_t instance, std::optional<int> level) {
    const std::string who = whoIs(scene, instance);
    std::erase_if(forced, [&](const ForcedLevel& f) { return f.who == who; });
    if (level || forcedLevels(scene, writeForced(forced))[instance] != none) forced.push_back({who, level});
    return forced;
}

std::vector<ForcedLevel> withAllMoved(const Scene& scene, std::span<const std::uint32_t> now, int step) {
    std::vector<int> moved(scene.instances.size());
    std::array<std::size_t, maxLevels> count{};
    std::vector<std::uint32_t> levels;
    for (const Mesh& mesh : scene.meshes) levels.push_back(levelsToChoose(scene, mesh));
    for (std::size_t i = 0; i < moved.size(); ++i) {
        moved[i] = std::clamp(int(now[i]) + step, 0, int(levels[scene.instances[i].mesh]) - 1);
        ++count[std::size_t(moved[i])];
    }
    // The level of most is said of all, and then what the others show, by number: a frame reads thousands of those quickly.
    const int most = int(std::ranges::max_element(count) - count.begin());
    std::vector<ForcedLevel> forced{{"*", most}};
    for (std::uint32_t i = 0; i < moved.size(); ++i)
        if (moved[i] != std::min(most, int(levels[scene.instances[i].mesh]) - 1)) forced.push_back({"#" + std::to_string(i), moved[i]});
    return forced;
}

}  // namespace lodestir
