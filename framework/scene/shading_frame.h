// SPDX-License-Identifier: MIT
// Normals for triangles whose file gives none, or bad ones, and what tangents and lights need besides.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

/// A unit vector at right angles to the unit vector `n`.
LODESTIR_API glm::vec3 perpendicular(glm::vec3 n);

/// Vertex i of the level becomes what vertex from[i] was.
void gatherVertices(MeshLevel& level, const std::vector<std::uint32_t>& from);

/// KHR_texture_transform: uv' = offset + (c x + s y, -s x + c y) with (x, y) = scale * uv, c and s of the rotation: the picture
/// turns clockwise about the origin of the texture coordinates.
LODESTIR_API glm::vec2 transformUv(const TextureSlot& slot, glm::vec2 uv);

/// Vertex i of the level becomes what vertex from[i] was; its triangles stay.
LODESTIR_API void gatherVertices(MeshLevel& level, const std::vector<std::uint32_t>& from);

/// Gives each triangle three vertices of its own with the normal of its face (glTF 2.0, section 3.7.2.1: flat normals).
LODESTIR_API void makeFlatNormals(MeshLevel& level);

/// Scales normals to unit length; those that are zero or not finite are made from the faces around, weighted by area.
/// Returns how many were made.
LODESTIR_API std::size_t repairNormals(MeshLevel& level);

}  // namespace lodestir
