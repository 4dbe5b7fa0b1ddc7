// SPDX-License-Identifier: MIT
#include "baked_content.h"

#include <algorithm>
#include <limits>

namespace lodestir {
namespace {

void addMap(Hash& hash, const Scene& scene, const TextureSlot& slot) {
    hash.addValue(slot.texture != none);
    if (slot.texture == none) return;
    const Texture& t = scene.textures[slot.texture];
    hash.addValue(slot.uvSet).addValue(slot.offset).addValue(slot.scale).addValue(slot.rotation);
    hash.addValue(t.width).addValue(t.height).addValue(t.srgb).addValue(t.nearest).addValue(t.wrapU).addValue(t.wrapV);
    hash.add(std::as_bytes(std::span(t.rgba)));
}

}  // namespace

Hash bakedContent(const Scene& scene, const SceneRecords& records, std::uint32_t mesh, const Palette& palette) {
    const LevelRecord& level = records.meshLevels[mesh * LEVELS];
    const auto triangles = records.primitives.subspan(level.firstPrimitive, level.primitiveCount);
    std::uint32_t first = std::numeric_limits<std::uint32_t>::max(), last = 0;
    for (const PrimitiveRecord& t : triangles) {
        first = std::min({first, t.v0, t.v1, t.v2});
        last = std::max({last, t.v0, t.v1, t.v2});
    }
    const std::vector<std::uint32_t> numbers = palette.numbers(scene);
    std::vector<glm::uvec4> corners;
    corners.reserve(triangles.size());
    for (const PrimitiveRecord& t : triangles) corners.emplace_back(t.v0 - first, t.v1 - first, t.v2 - first, numbers[t.material]);

    Hash hash;
    hash.add(std::as_bytes(std::span(corners)));
    hash.add(std::as_bytes(records.positions.subspan(first, last - first + 1))).add(std::as_bytes(records.vertices.subspan(first, last - first + 1)));
    for (std::size_t i = 0; i < palette.materials.size(); ++i) {
        const Material& m = scene.materials[palette.materials[i]];
        hash.addValue(palette.places[i]).addValue(m.doubleSided).addValue(m.alphaMode).addValue(m.normalScale);
        addMap(hash, scene, m.normalMap);
        if (m.alphaMode != AlphaMode::mask) continue;
        hash.addValue(m.alphaCutoff).addValue(m.baseColor.a);
        addMap(hash, scene, m.baseColorMap);
    }
    return hash;
}

}  // namespace lodestir
