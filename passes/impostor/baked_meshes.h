// SPDX-License-Identifier: MIT
// Which meshes of a scene are baked, and the spheres that their views stand around.
#pragma once
#include <framework/pass/pass.h>
#include <framework/pass/scene.h>

#include <limits>
#include <set>

namespace lodestir {

/// Indices of the meshes with triangles that instances show; of those named `wanted`, if it isn't empty. `pass`: who bakes them, for the message.
inline std::vector<std::uint32_t> bakedMeshes(const Scene& scene, const std::string& wanted, const std::string& pass) {
    std::set<std::uint32_t> shown;
    std::vector<std::string> names;
    for (const Instance& instance : scene.instances) {
        const std::string& name = scene.meshes[instance.mesh].name;
        names.push_back(name);
        if ((wanted.empty() || name == wanted) && !scene.meshes[instance.mesh].levels.front().triangles.empty()) shown.insert(instance.mesh);
    }
    if (!wanted.empty() && shown.empty())
        throw Error(Where{scene.file.string()}, "no instance shows a mesh \"" + wanted + "\" for an " + pass + " to bake", didYouMean(wanted, names));
    return {shown.begin(), shown.end()};
}

struct Sphere {
    glm::vec3 center;
    float radius;
};

/// Around the finest level of a mesh, from the middle of its box: a ball fills its views.
inline Sphere sphereAround(const SceneRecords& scene, std::uint32_t mesh) {
    const LevelRecord& level = scene.meshLevels[mesh * LEVELS];
    const auto triangles = scene.primitives.subspan(level.firstPrimitive, level.primitiveCount);
    glm::vec3 low(std::numeric_limits<float>::max()), high = -low;
    for (const PrimitiveRecord& t : triangles) {
        for (const std::uint32_t v : {t.v0, t.v1, t.v2}) {
            low = glm::min(low, glm::vec3(scene.positions[v]));
            high = glm::max(high, glm::vec3(scene.positions[v]));
        }
    }
    Sphere sphere{low + 0.5f * (high - low), 0};
    for (const PrimitiveRecord& t : triangles)
        for (const std::uint32_t v : {t.v0, t.v1, t.v2})
            sphere.radius = std::max(sphere.radius, glm::distance(sphere.center, glm::vec3(scene.positions[v])));
    return sphere;
}

}  // namespace lodestir
