// SPDX-License-Identifier: MIT
// Normals made from positions, and the rules of texture coordinates.
#include <framework/core/tasks.h>
#include <framework/scene/shading_frame.h>

#include <cmath>
#include <mutex>

namespace lodestir {
namespace {

template <class T> void gather(std::vector<T>& values, const std::vector<std::uint32_t>& from) {
    if (values.empty()) return;
    std::vector<T> result(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) result[i] = values[from[i]];
    values = std::move(result);
}

/// Twice the triangle's area along its normal, in double precision: edges of 1e-20 still have a direction.
glm::dvec3 areaVector(const MeshLevel& level, const glm::uvec3& t) {
    const glm::dvec3 a(level.positions[t.x]), b(level.positions[t.y]), c(level.positions[t.z]);
    return glm::cross(b - a, c - a);
}

glm::vec3 normalizeOr(const glm::dvec3& v, glm::vec3 otherwise) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? glm::vec3(v / length) : otherwise;
}

}  // namespace

glm::vec3 perpendicular(glm::vec3 n) {
    const glm::vec3 axis = std::abs(n.x) < 0.57735f   ? glm::vec3(1, 0, 0)
                           : std::abs(n.y) < 0.57735f ? glm::vec3(0, 1, 0)
                                                      : glm::vec3(0, 0, 1);
    return glm::normalize(axis - n * glm::dot(n, axis));
}

void gatherVertices(MeshLevel& level, const std::vector<std::uint32_t>& from) {
    gather(level.positions, from);
    gather(level.normals, from);
    gather(level.tangents, from);
    gather(level.uv0, from);
    gather(level.uv1, from);
    gather(level.colors, from);
    gather(level.joints, from);
    for (MorphTarget& target : level.targets) {
        gather(target.positions, from);
        gather(target.normals, from);
        gather(target.tangents, from);
    }
}

glm::vec2 transformUv(const TextureSlot& slot, glm::vec2 uv) {
    const glm::vec2 scaled = slot.scale * uv;
    const float c = std::cos(slot.rotation), s = std::sin(slot.rotation);
    return slot.offset + glm::vec2(c * scaled.x + s * scaled.y, -s * scaled.x + c * scaled.y);
}

void makeFlatNormals(MeshLevel& level) {
    std::vector<std::uint32_t> from;
    from.reserve(level.triangles.size() * 3);
    std::vector<glm::vec3> normals;
    normals.reserve(level.triangles.size() * 3);
    for (glm::uvec3& t : level.triangles) {
        const glm::vec3 normal = normalizeOr(areaVector(level, t), {0, 0, 1});
        for (int c = 0; c < 3; ++c) {
            from.push_back(t[c]);
            normals.push_back(normal);
            t[c] = static_cast<std::uint32_t>(from.size() - 1);
        }
    }
    level.normals.clear();
    gatherVertices(level, from);
    level.normals = std::move(normals);
}

std::size_t repairNormals(MeshLevel& level) {
    std::vector<std::size_t> broken;
    std::mutex mutex;
    parallelFor(level.normals.size(), 65536, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            glm::vec3& normal = level.normals[v];
            const double length = glm::length(glm::dvec3(normal));
            if (std::isfinite(length) && length > 1e-6) {
                normal = glm::vec3(glm::dvec3(normal) / length);
                continue;
            }
            const std::lock_guard lock(mutex);
            broken.push_back(v);
        }
    });
    if (broken.empty()) return 0;
    std::vector<glm::dvec3> around(level.positions.size(), glm::dvec3(0));
    for (const glm::uvec3& t : level.triangles) {
        const glm::dvec3 area = areaVector(level, t);
        for (int c = 0; c < 3; ++c) around[t[c]] += area;
    }
    for (const std::size_t v : broken) level.normals[v] = normalizeOr(around[v], {0, 0, 1});
    return broken.size();
}

}  // namespace lodestir
