// SPDX-License-Identifier: MIT
// Indexed triangle meshes: joining, placing, bending, and the normals and tangents that follow from shape and UVs.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

namespace lodestir::generate {

/// UVs as in glTF: v runs down the picture.
struct Vertex {
    glm::vec3 position{0};
    glm::vec3 normal{0, 1, 0};
    glm::vec2 uv{0};
    glm::vec4 tangent{1, 0, 0, 1};
    glm::vec3 color{1};
};

/// Counter-clockwise triangles seen from outside; metres.
struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;
    bool hasTangents = false;  ///< set by computeTangents()
    bool hasColors = false;    ///< set by whoever paints vertices

    uint32_t add(const Vertex& vertex) {
        vertices.push_back(vertex);
        return uint32_t(vertices.size() - 1);
    }
    void triangle(uint32_t a, uint32_t b, uint32_t c) { indices.insert(indices.end(), {a, b, c}); }

    /// Two triangles a-b-c, a-c-d.
    void quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d) { indices.insert(indices.end(), {a, b, c, a, c, d}); }

    size_t triangleCount() const { return indices.size() / 3; }
};

/// Adds the vertices and triangles of `part` to `mesh`.
void append(Mesh& mesh, const Mesh& part);

/// `mesh` placed by an affine transform; normals by the inverse transpose, winding kept outward under reflections.
Mesh placed(Mesh mesh, const glm::mat4& transform);

/// Translation, as shorthand for the most frequent transform.
Mesh placed(Mesh mesh, const glm::vec3& offset);

/// `mesh` with every position sent through `bend`, and smooth normals recomputed.
Mesh bent(Mesh mesh, const std::function<glm::vec3(const glm::vec3&)>& bend, float creaseDegrees = 40);

/// Normals as the angle-weighted mean of the triangles around a position that lie within `creaseDegrees` of each other.
/// Vertices are split at creases and welded where position, normal and UV agree; 180 smooths everything.
void computeNormals(Mesh& mesh, float creaseDegrees);

/// Tangents along +u, with w such that cross(normal, tangent) * w points up the picture (glTF 2.0, section 3.7.2.1).
void computeTangents(Mesh& mesh);

/// Multiplies and shifts all UVs.
void scaleUv(Mesh& mesh, const glm::vec2& scale, const glm::vec2& offset = glm::vec2(0));
/// UVs of metres for a picture that repeats after `repeat` metres.
Mesh inTiles(Mesh mesh, float repeat);

}  // namespace lodestir::generate
