// SPDX-License-Identifier: MIT
#include <framework/scene/lod/appearance_tree.h>

namespace lodestir {

AppearanceTree::AppearanceTree(const TriangleTree& tree, const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                               const Appearance& appearance)
    : tree_(tree), positions_(positions), triangles_(triangles), appearance_(appearance) {
    const std::size_t size = appearance.size();
    bounds_.resize(2 * size * tree.boxes());
    const auto lowOf = [&](std::uint32_t box) { return std::span(bounds_).subspan(2 * size * box, size); };
    const auto highOf = [&](std::uint32_t box) { return std::span(bounds_).subspan(2 * size * box + size, size); };
    std::ranges::fill(bounds_, std::numeric_limits<float>::max());
    for (std::uint32_t box = 0; box < tree.boxes(); ++box) std::ranges::fill(highOf(box), std::numeric_limits<float>::lowest());
    const auto widen = [&](std::uint32_t box, std::span<const float> low, std::span<const float> high) {
        for (std::size_t n = 0; n < size; ++n) {
            lowOf(box)[n] = std::min(lowOf(box)[n], low[n]);
            highOf(box)[n] = std::max(highOf(box)[n], high[n]);
        }
    };
    tree.gather(
        [&](std::uint32_t box, std::uint32_t triangle) {
            for (int k = 0; k < 3; ++k) widen(box, appearance.of(triangles[triangle][k]), appearance.of(triangles[triangle][k]));
        },
        [&](std::uint32_t box, std::uint32_t child) { widen(box, lowOf(child), highOf(child)); });
}

}  // namespace lodestir
