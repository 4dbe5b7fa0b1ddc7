// SPDX-License-Identifier: MIT
#include <framework/scene/upload/bottom_levels.h>

#include <algorithm>

namespace lodestir {

BottomLevels::BottomLevels(const gpu::Device& device, const Geometry& geometry) : device_(device) {
    std::vector<std::uint32_t> indices;
    indices.reserve(3 * geometry.primitives.values().size());
    for (const PrimitiveRecord& p : geometry.primitives.values()) indices.insert(indices.end(), {p.v0, p.v1, p.v2});
    indices_ = gpu::makeBuffer(device, std::span<const std::uint32_t>(indices), "indices");
}

std::shared_ptr<const BottomLevels::Table> BottomLevels::build(const Scene& scene, const Geometry& geometry, VkDeviceAddress positions) {
    std::vector<gpu::TriangleGeometry> wanted;
    std::map<std::uint32_t, std::size_t> place;  // in `wanted`, by first primitive
    std::vector<bool> deforms;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        for (std::size_t l = 0; l < LEVELS; ++l) {
            const LevelRecord& level = geometry.levels[m * LEVELS + l];
            if (level.primitiveCount == 0 || place.contains(level.firstPrimitive) || rigid_.contains(level.firstPrimitive)) continue;
            const auto masks = geometry.triangles.values().subspan(level.firstPrimitive, level.primitiveCount);
            place[level.firstPrimitive] = wanted.size();
            deforms.push_back(scene.meshes[m].deforms());
            wanted.push_back({.positions = positions,
                              .indices = indices_.address() + std::uint64_t(level.firstPrimitive) * 3 * sizeof(std::uint32_t),
                              .vertices = std::uint32_t(geometry.positions.values().size()),
                              .triangles = level.primitiveCount,
                              .stride = sizeof(glm::vec4),
                              .opaque = std::ranges::all_of(masks, [](const BvhTriangle& t) { return t.mask == 0; })});
        }
    }
    std::map<std::uint32_t, std::shared_ptr<const gpu::AccelerationStructure>> built = rigid_;
    if (!wanted.empty()) {
        auto structures = gpu::buildBottomLevels(device_, wanted);
        for (const auto& [first, i] : place) {
            built[first] = std::move(structures[i]);
            if (!deforms[i]) rigid_[first] = built[first];
        }
    }
    std::vector<std::uint64_t> addresses;
    for (const LevelRecord& level : geometry.levels) addresses.push_back(level.primitiveCount == 0 ? 0 : built.at(level.firstPrimitive)->address());
    auto table = std::make_shared<Table>();
    table->addresses = gpu::makeBuffer(device_, std::span<const std::uint64_t>(addresses), "bottom levels");
    for (const auto& [first, structure] : built) table->structures.push_back(structure);
    return table;
}

}  // namespace lodestir
