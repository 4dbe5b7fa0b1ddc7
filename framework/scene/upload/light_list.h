// SPDX-License-Identifier: MIT
// Which lights a scene has and how often each is chosen.
#pragma once
#include <framework/scene/scene.h>
#include <framework/shaders/world/world.h>

#include <span>
#include <vector>

namespace lodestir {

/// Triangles of a mesh's finest level whose materials are lights, in BVH order.
struct MeshEmitters {
    std::vector<std::uint32_t> primitives;  ///< indices into World.primitives
    std::vector<glm::uvec3> triangles;      ///< their vertex indices within the level
    std::vector<std::uint32_t> materials;
    bool empty() const { return primitives.empty(); }
};

struct LightList {
    std::vector<LightRecord> lights;
    std::vector<std::uint32_t> firstLight;  ///< of each instance, NONE: not emissive
    std::uint32_t environmentLight = NONE;
};

/// Lists emissive triangles by instance, then lights without extent, then the environment. The probability of a light is half
/// proportional to its power and half shared evenly among the kinds present, so that no kind starves. `positions` are those of each mesh's
/// finest level.
LightList listLights(const Scene& scene, std::span<const MeshEmitters> emitters, std::span<const std::span<const glm::vec4>> positions,
                     const std::vector<glm::mat4>& nodeMatrices, float sceneRadius);

}  // namespace lodestir
