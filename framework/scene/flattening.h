// SPDX-License-Identifier: MIT
// Matrices that squeeze a mesh flat. They have no inverse, or one that single precision is not enough for; so vertices take the matrix's shape
// themselves. And of what loses all its thickness fronts and backs would coincide; so it is left a little.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

/// What is left of a thickness of nothing, in shares of the size: seen from up to 200 sizes away, rounding still tells front and back apart.
inline constexpr double leastThickness = 0x1p-14;

/// Does the matrix leave less than `leastThickness` of a mesh of this extent (object units along its axes; 0: as along the longest)? True also where it
/// leaves a line or a point.
LODESTIR_API bool flattens(const glm::dmat3& matrix, glm::dvec3 extent);
/// The matrix itself; where single precision leaves the mesh no thickness at all, one that leaves it that much, and doesn't mirror; zero where it leaves a
/// line or a point.
LODESTIR_API glm::dmat3 thickened(const glm::dmat3& matrix, glm::dvec3 extent);

/// The longest that an axis of unit length becomes.
LODESTIR_API float sizeOf(const glm::mat4& matrix);
/// The linear part over its size, thickened.
LODESTIR_API glm::mat3 shapeOf(const glm::mat4& matrix, glm::dvec3 extent);

/// Gives each mesh that its instance's node makes flat, now or at some time of the animation, that node as its `shaper`, and instances that share it
/// meshes of their own. Notes where that would be too many vertices: those are not seen.
void shapeFlatInstances(Scene& scene);

}  // namespace lodestir
