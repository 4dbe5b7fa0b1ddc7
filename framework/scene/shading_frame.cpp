// SPDX-License-Identifier: MIT
// Normals and tangents made from positions and texture coordinates.
#include <framework/scene/shading_frame.h>

#include <cmath>

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

/// Derivatives of the position along u and v over one triangle; no valid ones where its texture coordinates span no area.
struct FaceTangents {
    glm::dvec3 alongU{0}, alongV{0};
    bool valid = false;
};

FaceTangents faceTangents(const MeshLevel& level, const glm::uvec3& t, const TextureSlot& slot) {
    const auto& uv = slot.uvSet == 1 ? level.uv1 : level.uv0;
    const glm::dvec2 uv0(transformUv(slot, uv[t.x]));
    const glm::dvec2 s = glm::dvec2(transformUv(slot, uv[t.y])) - uv0, r = glm::dvec2(transformUv(slot, uv[t.z])) - uv0;
    const glm::dvec3 p0(level.positions[t.x]);
    const glm::dvec3 e = glm::dvec3(level.positions[t.y]) - p0, f = glm::dvec3(level.positions[t.z]) - p0;
    const double area = s.x * r.y - s.y * r.x;
    if (area == 0 || !std::isfinite(area)) return {};
    return {(e * r.y - f * s.y) / area, (f * s.x - e * r.x) / area, true};
}

double cornerAngle(const MeshLevel& level, const glm::uvec3& t, int corner) {
    const glm::dvec3 p(level.positions[t[corner]]);
    const glm::dvec3 a = glm::dvec3(level.positions[t[(corner + 1) % 3]]) - p, b = glm::dvec3(level.positions[t[(corner + 2) % 3]]) - p;
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Splits the vertices that faces of both signs use; returns the sign of each vertex (0: only faces without texture area).
std::vector<int> splitMirrored(MeshLevel& level, const std::vector<int>& faceSigns) {
    std::vector<int> signs(level.positions.size(), 0);
    std::vector<std::uint32_t> from(level.positions.size()), mirrored(level.positions.size(), none);
    for (std::size_t v = 0; v < from.size(); ++v) from[v] = static_cast<std::uint32_t>(v);
    for (std::size_t i = 0; i < level.triangles.size(); ++i) {
        if (faceSigns[i] == 0) continue;
        for (int c = 0; c < 3; ++c) {
            std::uint32_t& v = level.triangles[i][c];
            if (signs[v] == 0) signs[v] = faceSigns[i];
            if (signs[v] == faceSigns[i]) continue;
            if (mirrored[v] == none) {
                mirrored[v] = static_cast<std::uint32_t>(from.size());
                from.push_back(v);
                signs.push_back(faceSigns[i]);
            }
            v = mirrored[v];
        }
    }
    if (from.size() > level.positions.size()) gatherVertices(level, from);
    return signs;
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
    std::size_t made = 0;
    std::vector<glm::dvec3> around;
    for (std::size_t v = 0; v < level.normals.size(); ++v) {
        glm::vec3& normal = level.normals[v];
        const double length = glm::length(glm::dvec3(normal));
        if (std::isfinite(length) && length > 1e-6) {
            normal = glm::vec3(glm::dvec3(normal) / length);
            continue;
        }
        if (around.empty()) {
            around.resize(level.positions.size(), glm::dvec3(0));
            for (const glm::uvec3& t : level.triangles) {
                const glm::dvec3 area = areaVector(level, t);
                for (int c = 0; c < 3; ++c) around[t[c]] += area;
            }
        }
        normal = normalizeOr(around[v], {0, 0, 1});
        ++made;
    }
    return made;
}

void makeTangents(MeshLevel& level, const TextureSlot& slot) {
    if ((slot.uvSet == 1 ? level.uv1 : level.uv0).empty()) {
        level.tangents.clear();
        for (const glm::vec3& n : level.normals) level.tangents.emplace_back(perpendicular(n), 1.0f);
        return;
    }
    std::vector<FaceTangents> faces;
    std::vector<int> faceSigns;
    for (const glm::uvec3& t : level.triangles) {
        const FaceTangents face = faceTangents(level, t, slot);
        const glm::dvec3 normal(level.normals[t.x] + level.normals[t.y] + level.normals[t.z]);
        faces.push_back(face);
        faceSigns.push_back(!face.valid ? 0 : glm::dot(normal, glm::cross(face.alongU, face.alongV)) < 0 ? 1 : -1);
    }
    const std::vector<int> signs = splitMirrored(level, faceSigns);

    std::vector<glm::dvec3> sums(level.positions.size(), glm::dvec3(0));
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if (!faces[i].valid) continue;
        for (int c = 0; c < 3; ++c) {
            const std::uint32_t v = level.triangles[i][c];
            const glm::dvec3 n(level.normals[v]), projected = faces[i].alongU - n * glm::dot(n, faces[i].alongU);
            const double length = glm::length(projected);
            if (length > 0) sums[v] += projected / length * cornerAngle(level, level.triangles[i], c);
        }
    }
    level.tangents.resize(level.positions.size());
    for (std::size_t v = 0; v < sums.size(); ++v) {
        level.tangents[v] = glm::vec4(normalizeOr(sums[v], perpendicular(level.normals[v])), signs[v] < 0 ? -1.0f : 1.0f);
    }
}

}  // namespace lodestir
