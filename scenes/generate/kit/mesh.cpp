// SPDX-License-Identifier: MIT
// Indexed triangle meshes: see mesh.h.
#include "mesh.h"

#include <array>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include <glm/gtc/matrix_transform.hpp>

#include "random.h"

namespace lodestir::generate {

namespace {

/// Bits of N floats as a map key; -0 and +0 are made one.
template <size_t N> struct Bits {
    std::array<uint32_t, N> words{};
    explicit Bits(const std::array<float, N>& values) {
        for (size_t i = 0; i < N; ++i) {
            const float value = values[i] == 0 ? 0.0f : values[i];
            std::memcpy(&words[i], &value, sizeof value);
        }
    }
    bool operator==(const Bits&) const = default;
};

struct BitsHash {
    template <size_t N> size_t operator()(const Bits<N>& bits) const {
        uint32_t h = uint32_t(N);
        for (uint32_t word : bits.words) h = hash(h, word);
        return h;
    }
};

using Position = Bits<3>;
Position positionKey(const glm::vec3& p) {
    // A hundredth of a millimetre: parts that were computed along different roads still meet.
    const glm::vec3 q = glm::round(p * 1e5f);
    return Position({q.x, q.y, q.z});
}

float cornerAngle(const glm::vec3& apex, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 e = b - apex, f = c - apex;
    return std::atan2(glm::length(glm::cross(e, f)), glm::dot(e, f));
}

}  // namespace

void append(Mesh& mesh, const Mesh& part) {
    const auto base = uint32_t(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
    mesh.indices.reserve(mesh.indices.size() + part.indices.size());
    for (uint32_t index : part.indices) mesh.indices.push_back(base + index);
    mesh.hasColors |= part.hasColors;
}

Mesh placed(Mesh mesh, const glm::mat4& transform) {
    const glm::mat3 linear(transform);
    const glm::mat3 normalMatrix = glm::transpose(glm::inverse(linear));
    const bool mirrored = glm::determinant(linear) < 0;
    for (Vertex& v : mesh.vertices) {
        v.position = glm::vec3(transform * glm::vec4(v.position, 1));
        v.normal = glm::normalize(normalMatrix * v.normal);
        v.tangent = glm::vec4(glm::normalize(linear * glm::vec3(v.tangent)), mirrored ? -v.tangent.w : v.tangent.w);
    }
    if (mirrored)
        for (size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    return mesh;
}

Mesh placed(Mesh mesh, const glm::vec3& offset) {
    for (Vertex& v : mesh.vertices) v.position += offset;
    return mesh;
}

Mesh bent(Mesh mesh, const std::function<glm::vec3(const glm::vec3&)>& bend, float creaseDegrees) {
    for (Vertex& v : mesh.vertices) v.position = bend(v.position);
    computeNormals(mesh, creaseDegrees);
    return mesh;
}

void computeNormals(Mesh& mesh, float creaseDegrees) {
    const size_t count = mesh.triangleCount();
    const float cosCrease = std::cos(glm::radians(creaseDegrees));

    // Unit normal of each triangle, and for each position the corners that meet there.
    struct Corner {
        uint32_t triangle;
        float angle;
    };
    std::vector<glm::vec3> flat(count);
    std::unordered_map<Position, std::vector<Corner>, BitsHash> around;
    around.reserve(mesh.vertices.size());
    for (uint32_t t = 0; t < count; ++t) {
        glm::vec3 p[3];
        for (int k = 0; k < 3; ++k) p[k] = mesh.vertices[mesh.indices[3 * t + uint32_t(k)]].position;
        const glm::vec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
        const float area = glm::length(n);
        flat[t] = area > 0 ? n / area : glm::vec3(0);
        for (int k = 0; k < 3; ++k) around[positionKey(p[k])].push_back({t, cornerAngle(p[k], p[(k + 1) % 3], p[(k + 2) % 3])});
    }

    // One normal per corner; equal corners are welded again.
    Mesh result;
    result.hasColors = mesh.hasColors;
    std::unordered_map<Bits<11>, uint32_t, BitsHash> known;
    known.reserve(mesh.vertices.size());
    for (uint32_t t = 0; t < count; ++t) {
        if (flat[t] == glm::vec3(0)) continue;  // a collapsed triangle (pole of a lathe) shows nothing
        uint32_t corners[3];
        for (int k = 0; k < 3; ++k) {
            Vertex v = mesh.vertices[mesh.indices[3 * t + uint32_t(k)]];
            glm::vec3 sum(0);
            for (const Corner& corner : around[positionKey(v.position)])
                if (creaseDegrees >= 180 || glm::dot(flat[corner.triangle], flat[t]) >= cosCrease)
                    sum += flat[corner.triangle] * corner.angle;
            v.normal = glm::dot(sum, sum) > 0 ? glm::normalize(sum) : flat[t];
            const glm::vec3 n = glm::round(v.normal * 4096.0f);
            const Bits<11> key({v.position.x, v.position.y, v.position.z, n.x, n.y, n.z, v.uv.x, v.uv.y, v.color.x, v.color.y, v.color.z});
            const auto [entry, fresh] = known.try_emplace(key, uint32_t(result.vertices.size()));
            if (fresh) result.vertices.push_back(v);
            corners[k] = entry->second;
        }
        result.triangle(corners[0], corners[1], corners[2]);
    }
    mesh = std::move(result);
}

void computeTangents(Mesh& mesh) {
    std::vector<glm::vec3> alongU(mesh.vertices.size(), glm::vec3(0));
    std::vector<glm::vec3> alongV(mesh.vertices.size(), glm::vec3(0));
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const uint32_t id[3] = {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        const Vertex &a = mesh.vertices[id[0]], &b = mesh.vertices[id[1]], &c = mesh.vertices[id[2]];
        const glm::vec3 e = b.position - a.position, f = c.position - a.position;
        const glm::vec2 s = b.uv - a.uv, t = c.uv - a.uv;
        const float area = s.x * t.y - s.y * t.x;
        if (std::abs(area) < 1e-12f) continue;
        const glm::vec3 u = (e * t.y - f * s.y) / area;
        const glm::vec3 v = (f * s.x - e * t.x) / area;
        for (int k = 0; k < 3; ++k) {
            const float angle = cornerAngle(mesh.vertices[id[k]].position, mesh.vertices[id[(k + 1) % 3]].position,
                                            mesh.vertices[id[(k + 2) % 3]].position);
            alongU[id[k]] += glm::normalize(u) * angle;
            alongV[id[k]] += glm::normalize(v) * angle;
        }
    }
    for (size_t i = 0; i < mesh.vertices.size(); ++i) {
        Vertex& vertex = mesh.vertices[i];
        const glm::vec3 n = vertex.normal;
        glm::vec3 t = alongU[i] - n * glm::dot(n, alongU[i]);
        if (glm::dot(t, t) < 1e-12f)  // no UV direction here (a pole): any perpendicular will do
            t = glm::cross(n, std::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0));
        t = glm::normalize(t);
        // v runs down, so "up the picture" is -alongV.
        vertex.tangent = glm::vec4(t, glm::dot(glm::cross(n, t), alongV[i]) > 0 ? -1.0f : 1.0f);
    }
    mesh.hasTangents = true;
}

void scaleUv(Mesh& mesh, const glm::vec2& scale, const glm::vec2& offset) {
    for (Vertex& v : mesh.vertices) v.uv = v.uv * scale + offset;
}

Mesh inTiles(Mesh mesh, float repeat) {
    scaleUv(mesh, glm::vec2(1 / repeat));
    return mesh;
}

}  // namespace lodestir::generate
