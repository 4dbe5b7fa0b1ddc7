// SPDX-License-Identifier: MIT
// A surface welded for simplification: places in space, and wedges, the charts' corners at each place.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

/// Points of equal position, UVs, colour, group (MeshLevel::materials) and UV orientation are one wedge, whatever their normals: hard edges
/// may move, borders of charts and groups are told from the inside. Where mirrored halves meet they are different wedges too.
struct Wedges {
    explicit Wedges(const MeshLevel& surface);

    std::vector<std::uint32_t> places;                 ///< of each wedge; wedges of one position share it
    std::vector<glm::vec3> positions;                  ///< of each wedge
    std::vector<glm::vec2> uvs;                        ///< of each wedge; zero without UVs
    std::vector<int> orientations;                     ///< of each wedge: sign of the UV area of its triangles; 0: they have none
    std::vector<std::uint32_t> groups;                 ///< of each wedge
    std::vector<std::vector<std::uint32_t>> vertices;  ///< of the surface, of each wedge
    std::vector<glm::uvec3> triangles;                 ///< of wedges; without those of no area in index or of places that are not finite
    std::size_t placeCount = 0;
};

/// Twice the signed area of a triangle in the UV plane.
double uvArea(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c);

}  // namespace lodestir
