// SPDX-License-Identifier: MIT
#include "palette.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace lodestir {
namespace {

std::vector<double> areasOf(const Scene& scene, const MeshLevel& level) {
    std::vector<double> areas(scene.materials.size(), 0);
    for (std::size_t i = 0; i < level.triangles.size(); ++i) {
        const glm::uvec3 t = level.triangles[i];
        const glm::dvec3 a = level.positions[t.x], b = level.positions[t.y], c = level.positions[t.z];
        areas[level.materials[i]] += glm::length(glm::cross(b - a, c - a));
    }
    return areas;
}

float difference(const Material& a, const Material& b) {
    const glm::vec4 color = a.baseColor - b.baseColor;
    const glm::vec2 rest(a.metallic - b.metallic, a.roughness - b.roughness);
    return glm::dot(color, color) + glm::dot(rest, rest);
}

}  // namespace

std::vector<std::uint32_t> Palette::numbers(const Scene& scene) const {
    std::vector<std::uint32_t> numbers(scene.materials.size(), NONE);
    for (std::uint32_t i = 0; i < materials.size(); ++i) numbers[materials[i]] = i;
    return numbers;
}

Palette paletteOf(const Scene& scene, const Mesh& mesh) {
    const std::vector<double> areas = areasOf(scene, mesh.levels.front());
    Palette palette;
    std::vector<std::uint32_t>& order = palette.materials;
    order.resize(areas.size());
    std::iota(order.begin(), order.end(), 0u);
    std::erase_if(order, [&](std::uint32_t m) { return !(areas[m] > 0); });
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) { return areas[a] > areas[b]; });

    for (std::uint32_t i = 0; i < order.size(); ++i) {
        std::uint32_t place = i;
        if (i >= PALETTE) {
            const auto large = std::span(order).first(PALETTE);
            const auto like = std::ranges::min_element(large, {}, [&](std::uint32_t m) { return difference(scene.materials[m], scene.materials[order[i]]); });
            place = std::uint32_t(like - large.begin());
            ++palette.merged;
        }
        palette.places.push_back(place);
    }
    return palette;
}

}  // namespace lodestir
