// SPDX-License-Identifier: MIT
// The layout of a scene's meshes on the device, as the CPU sees it.
#pragma once
#include <framework/shaders/world/world.h>

#include <span>

namespace lodestir {

/// What some arrays of every World hold, by the same names: where the triangles of a level lie, in which order, and their texture coordinates.
/// Only positions, normals and tangents follow the pose.
struct SceneRecords {
    std::span<const LevelRecord> meshLevels;  ///< of mesh m at level l: m * LEVELS + l
    std::span<const PrimitiveRecord> primitives;
    std::span<const VertexRecord> vertices;
    std::span<const glm::vec4> positions;  ///< of the vertices, object space, w 0, in the pose that was last asked for
};

}  // namespace lodestir
