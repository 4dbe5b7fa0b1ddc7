// SPDX-License-Identifier: MIT
// Normals and tangents for triangles whose file gives none, or bad ones.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

/// A unit vector at right angles to the unit vector `n`.
LODESTIR_API glm::vec3 perpendicular(glm::vec3 n);

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

/// Makes tangents along +u of the slot's texture: the faces' directions around a vertex, projected to its tangent plane and weighted
/// by the corner's angle as MikkTSpace does (Mikkelsen 2008, section 3.3). A vertex between mirrored faces is split in two.
/// The sign is +1 where the picture isn't mirrored: cross(normal, tangent) * sign points up in the picture, against v.
LODESTIR_API void makeTangents(MeshLevel& level, const TextureSlot& slot);

}  // namespace lodestir
