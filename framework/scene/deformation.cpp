// SPDX-License-Identifier: MIT
#include <framework/scene/deformation.h>

#include <framework/core/tasks.h>
#include <framework/scene/flattening.h>
#include <framework/scene/bvh/mesh_bounds.h>
#include <framework/scene/shading_frame.h>

#include <cmath>

namespace lodestir {
namespace {

constexpr std::size_t grain = 4096;  // vertices that are worth a task

glm::vec3 unitOr(glm::vec3 v, glm::vec3 otherwise) {
    const float length = glm::length(v);
    return length > 1e-20f && std::isfinite(length) ? v / length : otherwise;
}

void addTargets(PosedVertices& posed, const MeshLevel& level, std::span<const float> weights) {
    const std::size_t count = std::min(weights.size(), level.targets.size());
    for (std::size_t k = 0; k < count; ++k) {
        const MorphTarget& target = level.targets[k];
        const float weight = weights[k];
        if (weight == 0) continue;
        parallelFor(posed.positions.size(), grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t v = begin; v < end; ++v) {
                if (!target.positions.empty()) posed.positions[v] += weight * target.positions[v];
                if (!target.normals.empty()) posed.normals[v] += weight * target.normals[v];
                if (!target.tangents.empty() && !posed.tangents.empty()) posed.tangents[v] += glm::vec4(weight * target.tangents[v], 0);
            }
        });
    }
}

glm::mat4 blend(const VertexJoints& v, std::span<const glm::mat4> joints) {
    glm::mat4 sum(0);
    for (std::size_t i = 0; i < v.joints.size(); ++i)
        if (v.weights[i] > 0) sum += v.weights[i] * joints[v.joints[i]];
    return sum;
}

/// Of a matrix's columns, times its determinant: the transposed inverse without a division, so that flat matrices keep a direction.
glm::mat3 cofactors(const glm::mat3& m) { return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])}; }

void applySkin(PosedVertices& posed, const MeshLevel& level, std::span<const glm::mat4> joints) {
    parallelFor(posed.positions.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            const glm::mat4 matrix = level.joints.empty() ? joints[0] : blend(level.joints[v], joints);
            const glm::mat3 linear(matrix), normals = cofactors(linear);
            const float side = glm::dot(linear[0], normals[0]) < 0 ? -1.0f : 1.0f;
            posed.positions[v] = glm::vec3(matrix * glm::vec4(posed.positions[v], 1));
            posed.normals[v] = side * (normals * posed.normals[v]);
            if (!posed.tangents.empty())
                posed.tangents[v] = glm::vec4(linear * glm::vec3(posed.tangents[v]), side * posed.tangents[v].w);
        }
    });
}

/// Unit normals, and tangents at right angles to them; directions that cancelled out stay those of the rest pose.
void makeFrames(PosedVertices& posed, const MeshLevel& level) {
    for (std::size_t v = 0; v < posed.normals.size(); ++v) posed.normals[v] = unitOr(posed.normals[v], level.normals[v]);
    for (const glm::uvec3& t : level.flatFaces) {
        const glm::vec3 a = posed.positions[t.x];
        const glm::vec3 normal = unitOr(glm::cross(posed.positions[t.y] - a, posed.positions[t.z] - a), posed.normals[t.x]);
        posed.normals[t.x] = posed.normals[t.y] = posed.normals[t.z] = normal;
    }
    for (std::size_t v = 0; v < posed.tangents.size(); ++v) {
        const glm::vec3 n = posed.normals[v], t(posed.tangents[v]);
        posed.tangents[v] = glm::vec4(unitOr(t - n * glm::dot(n, t), perpendicular(n)), posed.tangents[v].w);
    }
}

}  // namespace

std::size_t deformingVertices(const Mesh& mesh) {
    std::size_t count = 0;
    for (const MeshLevel& level : mesh.levels) count += mesh.deforms() ? level.positions.size() * (1 + level.targets.size()) : 0;
    return count;
}

Pose poseAt(const Scene& scene, float frame) { return {scene.nodeMatrices(frame), scene.morphWeights(frame)}; }

std::vector<glm::mat4> jointMatrices(const Scene& scene, const Mesh& mesh, std::span<const glm::mat4> nodes) {
    if (mesh.shaper != none) return {glm::mat4(shapeOf(nodes[mesh.shaper], extentOf(mesh)))};
    std::vector<glm::mat4> matrices;
    if (mesh.skin == none) return matrices;
    const Skin& skin = scene.skins[mesh.skin];
    for (std::size_t i = 0; i < skin.nodes.size(); ++i) {
        glm::mat4 matrix = nodes[skin.nodes[i]] * skin.inverseBind[i];
        const glm::mat3 thick(thickened(glm::dmat3(matrix), glm::dvec3(1)));
        for (int axis = 0; axis < 3; ++axis) matrix[axis] = glm::vec4(thick[axis], matrix[axis].w);
        matrices.push_back(matrix);
    }
    return matrices;
}

PosedVertices deform(const MeshLevel& level, std::span<const float> weights, std::span<const glm::mat4> joints) {
    PosedVertices posed{level.positions, level.normals, level.tangents};
    addTargets(posed, level, weights);
    if (!joints.empty()) applySkin(posed, level, joints);
    makeFrames(posed, level);
    return posed;
}

PosedVertices deform(const Scene& scene, std::size_t mesh, std::size_t level, const Pose& pose) {
    const Mesh& source = scene.meshes[mesh];
    const MeshLevel& shape = source.levels[level];
    if (!source.deforms()) return {shape.positions, shape.normals, shape.tangents};
    return deform(shape, pose.weights[mesh], jointMatrices(scene, source, pose.nodes));
}

}  // namespace lodestir
