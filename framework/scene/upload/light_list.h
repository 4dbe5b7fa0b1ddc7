// SPDX-License-Identifier: MIT
// Which lights a scene has and how often each is chosen.
#pragma once
#include <framework/scene/scene.h>
#include <framework/shaders/world/world.h>

#include <functional>
#include <span>
#include <vector>

namespace lodestir {

/// Triangles of a level of a mesh whose materials are lights, in BVH order.
struct LevelEmitters {
    std::vector<std::uint32_t> primitives;  ///< indices into World.primitives
    std::vector<glm::uvec3> triangles;      ///< their vertex indices within the level
    std::vector<std::uint32_t> materials;
    bool empty() const { return primitives.empty(); }
};

struct LightList {
    std::vector<LightRecord> lights;           ///< `count`, and behind them those of coarser levels
    std::uint32_t count = 0;
    std::vector<std::uint32_t> firstLight;     ///< of each instance, NONE: not emissive
    std::vector<std::uint32_t> coarserLights;  ///< of each instance, place in `levels`; NONE: no lights at coarser levels
    std::vector<std::uint32_t> levels;         ///< where an instance's lights of its level 1 begin, of 2, ..., and where the last end
    std::uint32_t environmentLight = NONE;
};

/// Of a mesh at a level.
using PositionsOfLevel = std::function<std::span<const glm::vec4>(std::size_t mesh, std::size_t level)>;

/// Lists emissive triangles of finest levels by instance, then lights without extent, then the environment. The probability of a light is half
/// proportional to its power and half shared evenly among the kinds present, so that no kind starves. Behind them triangles of coarser levels: those of
/// one level of an instance share by power the numbers that its finest level has, so that a switch takes no number to another instance. `emitters`: of each
/// mesh, by level.
LightList listLights(const Scene& scene, std::span<const std::vector<LevelEmitters>> emitters, const PositionsOfLevel& positions,
                     const std::vector<glm::mat4>& nodeMatrices, float sceneRadius);

}  // namespace lodestir
