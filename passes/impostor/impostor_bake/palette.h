// SPDX-License-Identifier: MIT
// The few materials of a mesh that the coarse levels of its impostor tell apart.
#pragma once
#include <framework/pass/scene.h>

#include <passes/impostor/impostors.h>

#include <array>

namespace lodestir {

struct Palette {
    std::array<std::uint32_t, PALETTE> materials;  ///< the largest by area, the largest first; NONE: free
    std::vector<std::uint32_t> places;             ///< of each material of the scene; of those that found none, that of the one most like it
    std::uint32_t merged = 0;                      ///< materials of the mesh that found none
};
Palette paletteOf(const Scene& scene, const Mesh& mesh);

}  // namespace lodestir
