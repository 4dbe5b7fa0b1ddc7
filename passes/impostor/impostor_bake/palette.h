// SPDX-License-Identifier: MIT
// The materials of a mesh, and the few of them that the coarse levels of its impostor tell apart.
#pragma once
#include <framework/pass/scene.h>

#include <framework/shaders/impostor/impostors.h>

#include <vector>

namespace lodestir {

struct Palette {
    std::vector<std::uint32_t> materials;  ///< that the finest level shows, the largest by area first; the first PALETTE have places of their own
    std::vector<std::uint32_t> places;     ///< of each of these; of those that found none, that of the one most like it
    std::uint32_t merged = 0;              ///< that found none

    /// For each material of the scene, its number in `materials`, or NONE.
    std::vector<std::uint32_t> numbers(const Scene& scene) const;
};
Palette paletteOf(const Scene& scene, const Mesh& mesh);

}  // namespace lodestir
