// SPDX-License-Identifier: MIT
#include <framework/scene/flattening.h>

#include <framework/scene/deformation.h>
#include <framework/scene/bvh/mesh_bounds.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

constexpr double noise = 0x1p-20;  // of products of matrices in single precision, relative

glm::dmat3 cofactors(const glm::dmat3& m) { return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])}; }
double norm(const glm::dmat3& m) { return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2])); }
double longest(const glm::dmat3& m) { return std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])}); }

/// What a matrix does to a box: its columns are the sides.
struct Squeezed {
    glm::dvec3 extent;
    glm::dmat3 normals;  ///< cofactors of the sides: where two are left, the last singular vectors times the product of the others' values
    double size, volume, area;

    Squeezed(const glm::dmat3& m, glm::dvec3 extents) : extent(extents) {
        const double most = std::max({extent.x, extent.y, extent.z});
        for (int axis = 0; axis < 3; ++axis)
            if (!(extent[axis] > 0)) extent[axis] = most > 0 ? most : 1;
        const glm::dmat3 sides(m[0] * extent.x, m[1] * extent.y, m[2] * extent.z);
        normals = cofactors(sides);
        size = longest(sides);
        volume = glm::dot(sides[0], normals[0]);
        area = norm(normals);
    }
    bool isLine() const { return !(area > noise * size * size); }
    /// Is less than this share of the size left across the other two?
    bool isThin(double share) const { return isLine() || std::abs(volume) < share * size * area; }
};

/// The matrix has to squeeze: a mesh may be thin by itself. And the mesh has to come out thin: it may be drawn that much too deep.
bool leavesThin(const glm::dmat3& matrix, glm::dvec3 extent, double share) {
    return Squeezed(matrix, glm::dvec3(1)).isThin(share) && Squeezed(matrix, extent).isThin(share);
}

/// Does an axis lose its length while another has some?
bool flattensSometime(const AnimationChannel& channel) {
    if (channel.value != AnimatedValue::scale) return false;
    const std::size_t stride = channel.interpolation == Interpolation::cubic ? 3 : 1, first = stride / 2;
    for (std::size_t i = first; i < channel.values.size(); i += stride) {
        const glm::vec3 here(channel.values[i]);
        const int zeros = int(here.x == 0) + int(here.y == 0) + int(here.z == 0);
        if (zeros == 1 || zeros == 2) return true;
        if (channel.interpolation == Interpolation::step || i + stride >= channel.values.size()) continue;
        const glm::vec3 next(channel.values[i + stride]);
        const bool crosses = glm::any(glm::lessThan(here * next, glm::vec3(0)));
        if (crosses && glm::cross(here, next) != glm::vec3(0)) return true;  // else all cross at once
    }
    return false;
}

}  // namespace

bool flattens(const glm::dmat3& matrix, glm::dvec3 extent) { return leavesThin(matrix, extent, leastThickness); }

glm::dmat3 thickened(const glm::dmat3& matrix, glm::dvec3 extent) {
    if (!leavesThin(matrix, extent, noise)) return matrix;
    const Squeezed s(matrix, extent);
    if (s.isLine()) return glm::dmat3(0);
    glm::dmat3 result = matrix;
    for (int axis = 0; axis < 3; ++axis) result[axis] += s.normals[axis] * (leastThickness * s.size / (s.area * s.extent[axis]));
    return result;
}

float sizeOf(const glm::mat4& matrix) { return float(longest(glm::dmat3(matrix))); }

glm::mat3 shapeOf(const glm::mat4& matrix, glm::dvec3 extent) {
    const double size = sizeOf(matrix);
    return size > 0 ? glm::mat3(thickened(glm::dmat3(matrix), extent) / size) : glm::mat3(0);
}

void shapeFlatInstances(Scene& scene) {
    std::vector<bool> squeezed(scene.nodes.size(), false);  // by the animation, at some time
    for (const AnimationChannel& channel : scene.animation) squeezed[channel.node] = squeezed[channel.node] || flattensSometime(channel);
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        if (scene.nodes[n].parent != none && squeezed[scene.nodes[n].parent]) squeezed[n] = true;

    const std::vector<glm::mat4> matrices = scene.nodeMatrices(0);
    std::vector<std::size_t> users(scene.meshes.size(), 0);
    std::size_t deforming = 0;
    for (const Instance& instance : scene.instances) ++users[instance.mesh];
    for (const Mesh& mesh : scene.meshes) deforming += deformingVertices(mesh);
    bool tooMany = false;
    for (Instance& instance : scene.instances) {
        if (scene.meshes[instance.mesh].skin != none) continue;
        const glm::dmat3 linear(matrices[instance.node]);
        if (!squeezed[instance.node] && (linear == glm::dmat3(0) || !flattens(linear, extentOf(scene.meshes[instance.mesh])))) continue;
        Mesh mesh = scene.meshes[instance.mesh];
        mesh.shaper = instance.node;
        deforming += deformingVertices(mesh);
        if (deforming > maxDeforming) {
            tooMany = true;
            break;
        }
        if (users[instance.mesh] > 1) {
            --users[instance.mesh];
            instance.mesh = std::uint32_t(scene.meshes.size());
            scene.meshes.push_back(std::move(mesh));
            users.push_back(1);
        } else {
            scene.meshes[instance.mesh] = std::move(mesh);
        }
    }
    if (tooMany)
        scene.notes.push_back(fmt::format("with objects that their nodes make flat more than {} vertices deform: some of those are not seen", maxDeforming));
}

}  // namespace lodestir
