// SPDX-License-Identifier: MIT
// Meshes of a glTF model: all primitives of one mesh become one level with a material per triangle.
#pragma once
#include <framework/scene/gltf/import.h>

namespace lodestir {

/// The triangles of the file's mesh `index`: strips and fans taken apart, points, lines and modes that glTF has not left out with a note, triangles without
/// area or with a vertex that is not finite left out and counted in Scene::droppedTriangles, unused vertices left out.
/// Wrong accessors and indices past the vertices are gathered as problems.
MeshLevel loadGltfMesh(GltfImport& import, int index);

/// Scales a vertex's weights to sum to 1; without any it follows the first joint.
void makeWhole(VertexJoints& vertex);

/// The level with its vertices moved by an affine matrix.
void transformLevel(MeshLevel& level, const glm::mat4& matrix);

}  // namespace lodestir
