// SPDX-License-Identifier: MIT
// What is seen of a surface beside its place, measured in lengths, so that one distance tells how far two levels are apart.
#pragma once
#include <framework/scene/bvh/box.h>
#include <framework/scene/scene.h>
#include <framework/scene/bvh/triangle_tree.h>

#include <array>
#include <span>

namespace lodestir {

/// Attributes of a level's vertices, each scaled to a length in object units. Of the diagonal of the level's bounds, a 32nd stands for a
/// difference of 1 between colours (black and white) or alphas, a 3000th for one of 1 between unit normals or tangents (60 degrees); a unit of
/// UVs is as long as it is on the surface on average. So what differs by a tenth of the range of colours over an object that is 320 pixels
/// across is a pixel off.
class LODESTIR_API Appearance {
public:
    enum Part : unsigned { frames = 1, uv0 = 2, uv1 = 4, colors = 8, all = 15 };
    /// Those of the parts that the level has.
    Appearance(const MeshLevel& level, unsigned parts);

    static constexpr std::size_t most = 14;     ///< numbers a vertex
    std::size_t size() const { return size_; }  ///< of this level
    std::span<const float> of(std::uint32_t vertex) const { return std::span(values_).subspan(vertex * size_, size_); }
    std::size_t frameSize() const { return frameSize_; }  ///< the first numbers are of normals and tangents
    /// Gives all vertices other colours, other normals.
    void paint(const std::vector<glm::vec4>& values);
    void turn(const std::vector<glm::vec3>& values);

private:
    std::size_t size_ = 0, frameSize_ = 0, colorPlace_ = 0;
    float frameLength_ = 0, colorLength_ = 0;
    std::vector<float> values_;
};

/// Bounds of a level's triangles with finite corners.
LODESTIR_API Box boundsOfTriangles(const MeshLevel& level);
/// The length of a unit of UVs on the surface on average: the root of the quotient of the areas, 0 where UVs span none.
LODESTIR_API double uvLength(const MeshLevel& level, const std::vector<glm::vec2>& uvs);

/// A point of a triangle and how far it is from the one looked for.
struct NearestPoint {
    std::uint32_t triangle = none;
    std::array<double, 3> weights{};  ///< barycentric
    double squaredDistance = 0;       ///< in space and appearance together
};

/// The point of a triangle of `surface` (positions and appearance of its corners) that is nearest to another, in space and appearance.
LODESTIR_API NearestPoint nearestOn(const glm::uvec3& triangle, const std::vector<glm::vec3>& positions, const Appearance& appearance,
                                    const glm::dvec3& position, std::span<const double> looks);

}  // namespace lodestir
