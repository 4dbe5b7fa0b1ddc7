// SPDX-License-Identifier: MIT
#include <framework/app/view/level_edit.h>

#include <algorithm>
#include <array>

namespace lodestir {

std::vector<ForcedLevel> withForced(const Scene& scene, std::vector<ForcedLevel> forced, std::uint32_t instance, std::optional<int> level) {
    const std::string who = whoIs(scene, instance);
    std::erase_if(forced, [&](const ForcedLevel& f) { return f.who == who; });
    if (level || forcedLevels(scene, writeForced(forced))[instance] != none) forced.push_back({who, level});
    return forced;
}

std::vector<ForcedLevel> withAllMoved(const Scene& scene, std::span<const std::uint32_t> now, int step) {
    std::vector<int> moved(scene.instances.size());
    std::array<std::size_t, maxLevels> count{};
    const auto coarsest = [&](std::size_t instance) { return int(scene.meshes[scene.instances[instance].mesh].levels.size()) - 1; };
    for (std::size_t i = 0; i < moved.size(); ++i) {
        moved[i] = std::clamp(int(now[i]) + step, 0, coarsest(i));
        ++count[std::size_t(moved[i])];
    }
    // The level of most is said of all, and then what the others show, by number: a frame reads thousands of those quickly.
    const int most = int(std::ranges::max_element(count) - count.begin());
    std::vector<ForcedLevel> forced{{"*", most}};
    for (std::uint32_t i = 0; i < moved.size(); ++i)
        if (moved[i] != std::min(most, coarsest(i))) forced.push_back({"#" + std::to_string(i), moved[i]});
    return forced;
}

}  // namespace lodestir
