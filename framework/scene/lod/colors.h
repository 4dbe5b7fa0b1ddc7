// SPDX-License-Identifier: MIT
// Vertex colours of a coarse level: what the finest level's colours are on average around each vertex.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

/// Colours that, interpolated over the coarse level's triangles, come closest to the finest level's: least squares over its area, which keep
/// the mean of each channel (the difference is orthogonal to constants), and stay within the range that the finest level's colours span.
/// Vertices of one place and colour are given one colour; `groups` as in LodLevel: colours don't cross from one to another. Of each of the
/// finest level's vertices; those that the coarse level doesn't use keep theirs. Empty where there are no colours.
LODESTIR_API std::vector<glm::vec4> coarseColors(const MeshLevel& finest, const std::vector<glm::uvec3>& coarse,
                                                 const std::vector<std::uint32_t>& groups);

}  // namespace lodestir
