// SPDX-License-Identifier: MIT
// Colours and normals of a coarse level: what those of the level before are on average around each vertex.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

/// Of each vertex that both levels are made of; what the coarse one doesn't use is as it was. Empty where there are none.
struct VertexFit {
    std::vector<glm::vec4> colors;
    std::vector<glm::vec3> normals;
};

/// Colours and unit normals that, interpolated over the coarse level's triangles, come closest to those of a finer level of the same vertices: least squares
/// over its area, which keep the mean of each channel (the difference is orthogonal to constants), and stay within the range that the finer level's values
/// span. So a bump that a level can't hold any more is no normal of it either: a vertex that happened to be left would speak for a whole slope. Vertices of
/// one place and value are given one value; `groups` as in LodLevel: values don't cross from one to another.
LODESTIR_API VertexFit fitVertices(const MeshLevel& finer, const std::vector<glm::uvec3>& coarse, const std::vector<std::uint32_t>& groups);

}  // namespace lodestir
