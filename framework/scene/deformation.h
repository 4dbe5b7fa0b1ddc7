// SPDX-License-Identifier: MIT
// Vertices that move against each other: morph targets, then a skin.
#pragma once
#include <framework/scene/scene.h>

#include <span>

namespace lodestir {

/// The vertices of a level as a pose leaves them. Each array is as long as the level's.
struct PosedVertices {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;
};

/// Vertices of a mesh and of its morph targets, 0 where it doesn't deform. Each instance has its own; a scene has `maxDeforming` at most, so
/// that small files cannot ask for all memory there is.
std::size_t deformingVertices(const Mesh& mesh);
inline constexpr std::size_t maxDeforming = std::size_t(1) << 25;

/// All that moves a scene at a frame.
struct Pose {
    std::vector<glm::mat4> nodes;            ///< to world
    std::vector<std::vector<float>> weights; ///< of each mesh's morph targets
    bool operator==(const Pose&) const = default;
};
LODESTIR_API Pose poseAt(const Scene& scene, float frame);

/// From a mesh's vertices to the world by each joint of its skin: node matrix times inverse bind matrix (glTF 2.0, section 3.7.3.3); the shape of its
/// shaper; empty without both. Those without thickness are thickened (flattening.h).
std::vector<glm::mat4> jointMatrices(const Scene& scene, const Mesh& mesh, std::span<const glm::mat4> nodes);

/// p' = sum over joints of weight * matrix * (p + sum over targets of weight * displacement) (glTF 2.0, sections 3.7.2.2 and 3.7.3.3);
/// normals by the transposed inverse of the blended matrix, flat ones from the moved faces. A level without joints follows the only matrix, if there
/// is one. Parallel, the same bits for any core count.
LODESTIR_API PosedVertices deform(const MeshLevel& level, std::span<const float> weights, std::span<const glm::mat4> joints);
/// The same for level `l` of a mesh of the scene; what does not deform stays as it is.
LODESTIR_API PosedVertices deform(const Scene& scene, std::size_t mesh, std::size_t level, const Pose& pose);

}  // namespace lodestir
