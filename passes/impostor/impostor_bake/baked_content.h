// SPDX-License-Identifier: MIT
// What the texels of a mesh depend on, whatever else is in the scene.
#pragma once
#include "palette.h"

namespace lodestir {

/// Of the finest level in the pose that the records have: its triangles and vertices, and of its materials what is baked of them. Colours are not.
Hash bakedContent(const Scene& scene, const SceneRecords& records, std::uint32_t mesh, const Palette& palette);

}  // namespace lodestir
