// SPDX-License-Identifier: MIT
// How the texels of a mesh lie in one piece of memory.
#pragma once
#include <framework/shaders/impostor/impostors.h>

#include <algorithm>
#include <cstdint>

namespace lodestir {

class TexelMemory {
public:
    explicit TexelMemory(const Impostors& impostors) : compressed_(impostors.compressed != 0) {
        for (std::uint32_t level = 0; level < impostors.levels; ++level) {
            const std::uint64_t side = impostors.resolution >> level;
            all_ += side * side * impostors.views;
            if (level == 0) finest_ = all_;
            tiles_ += std::uint64_t(tilesAcross(impostors, level)) * tilesAcross(impostors, level) * impostors.views;
        }
    }
    /// Tiles of 8x8 texels a side of a view.
    static std::uint32_t tilesAcross(const Impostors& impostors, std::uint32_t level) { return std::max(1u, (impostors.resolution >> level) / 8); }

    std::uint64_t bytes() const { return tiles() + tiles_ * sizeof(TileRecord); }
    void place(std::uint64_t address, ImpostorRecord& record) const {
        record.shapes = address;
        record.uvs = address + uvs();
        record.materials = address + materials();
        record.counts = address + counts();
        record.tiles = address + tiles();
    }

private:
    std::uint64_t uvs() const { return compressed_ ? all_ / 16 * sizeof(ShapeBlock) : all_ * sizeof(glm::uvec4); }
    std::uint64_t materials() const { return uvs() + all_ * 4; }
    std::uint64_t counts() const { return materials() + finest_ * (compressed_ ? 2 : 4); }
    std::uint64_t tiles() const { return counts() + (all_ - finest_) * 4; }

    bool compressed_;
    std::uint64_t all_ = 0, finest_ = 0;  ///< texels of all levels, and of the finest
    std::uint64_t tiles_ = 0;
};

}  // namespace lodestir
