// SPDX-License-Identifier: MIT
// How far a mesh reaches, whatever level of it is shown.
#pragma once
#include <framework/scene/bvh/box.h>
#include <framework/scene/scene.h>

namespace lodestir {

/// Box over all levels, object space.
LODESTIR_API Box boundsOf(const Mesh& mesh);
/// Its sides; 0 without vertices.
glm::dvec3 extentOf(const Mesh& mesh);

}  // namespace lodestir
