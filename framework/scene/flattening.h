// SPDX-License-Identifier: MIT
// Matrices that squeeze a mesh flat. They have no inverse, and fronts and backs of what was solid would coincide; so vertices take the matrix's shape
// themselves, and what would have no thickness is left a little.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

/// Least thickness of what a matrix squeezes, in shares of its size: seen from up to 200 sizes away, rounding still tells front and back apart.
inline constexpr double leastThickness = 0x1p-14;

/// Does the matrix leave less than `leastThickness` of a mesh of this extent (object units along its axes; 0: as along the longest)? True also where it
/// leaves a line or a point.
LODESTIR_API bool flattens(const glm::dmat3& matrix, glm::dvec3 extent);
/// The matrix itself, or one that leaves that thickness where the matrix flattens the mesh; zero where it leaves a line or a point.
/// Without thickness the matrix doesn't say what is mirrored: then nothing is.
LODESTIR_API glm::dmat3 thickened(const glm::dmat3& matrix, glm::dvec3 extent);

/// The longest that an axis of unit length becomes.
LODESTIR_API float sizeOf(const glm::mat4& matrix);
/// The linear part over its size, thickened.
LODESTIR_API glm::mat3 shapeOf(const glm::mat4& matrix, glm::dvec3 extent);

/// Gives each mesh that its instance's node makes flat, now or at some time of the animation, that node as its `shaper`, and instances that share it
/// meshes of their own. Notes where that would be too many vertices: those are not seen.
void shapeFlatInstances(Scene& scene);

}  // namespace lodestir
