// SPDX-License-Identifier: MIT
// Tangents by the rules of MikkTSpace, which normal maps are baked for.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

/// Makes tangents along +u of the slot's texture for triangles with normals, as glTF 2.0, section 3.7.2.1, prescribes for files that have
/// none. The method is Mikkelsen 2008's (Simulation of Wrinkled Surfaces Revisited, section 3.3, and the published description of
/// MikkTSpace): vertices with the same position, normal and texture coordinates are one; the triangles around one form groups, joined by
/// edges that two triangles of the same orientation in the texture share; each group has one tangent, the mean of its triangles' directions
/// in the plane of the normal, weighted by their angles there. A triangle without area in the texture joins the group that finds it first.
/// A vertex that corners of several groups use is split. The sign is +1 where the picture isn't mirrored: cross(normal, tangent) * sign
/// points up in the picture, against v.
LODESTIR_API void makeTangents(MeshLevel& level, const TextureSlot& slot);

}  // namespace lodestir
