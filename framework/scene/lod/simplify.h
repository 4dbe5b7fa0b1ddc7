// SPDX-License-Identifier: MIT
// Fewer triangles on the same vertices: edge collapse that keeps charts, materials and their borders together.
#pragma once
#include <framework/scene/lod/appearance.h>
#include <framework/scene/lod/attribute_quadrics.h>
#include <framework/scene/lod/quadric.h>
#include <framework/scene/lod/wedges.h>

#include <queue>

namespace lodestir {

/// A surface of fewer triangles; vertices are those of the surface it comes from.
struct Simplified {
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint32_t> groups;  ///< of each triangle: MeshLevel::materials of those it stands for
};

/// Takes places away one by one, each to a neighbour, the one that changes what is seen least first: surface and texture that move (Garland
/// and Heckbert 1998), and normals, tangents, second UVs and colours that become others (Hoppe 1999), all as lengths (Appearance).
/// - All wedges of a place go to wedges of the neighbour within their own charts, or the place stays: borders of charts and groups move
///   along themselves and stay closed, and so does the line where mirrored halves meet. Open borders move along themselves.
/// - No triangle may turn over, in space or in the UV plane; places where more than two triangles share an edge stay.
/// The result is the same every time.
class LODESTIR_API Simplifier {
public:
    explicit Simplifier(const MeshLevel& surface);

    /// Goes on until there are no more than `triangles`, or nothing can be taken away.
    void reduce(std::size_t triangles);
    std::size_t triangleCount() const { return alive_; }
    Simplified result() const;

private:
    struct Step {
        double cost;
        std::uint32_t from, to;  ///< places
        std::uint32_t age;       ///< of `from` when the step was found
        bool operator<(const Step& other) const { return cost != other.cost ? cost > other.cost : from > other.from; }
    };
    using Targets = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  ///< wedge of the place, wedge that it goes to

    void addQuadrics();
    void findBorders();
    bool isHard(std::uint32_t wedge) const;
    std::uint32_t vertexLike(std::uint32_t wedge, std::uint32_t vertex) const;
    double attributeCost(std::uint32_t wedge, std::uint32_t target) const;
    std::uint32_t cornerAt(std::uint32_t triangle, std::uint32_t place) const;
    std::vector<std::uint32_t> neighbours(std::uint32_t place) const;
    bool findTargets(std::uint32_t from, std::uint32_t to, Targets& targets) const;
    bool keepsTopology(std::uint32_t from, std::uint32_t to) const;
    bool turnsOver(std::uint32_t from, std::uint32_t to, const Targets& targets) const;
    bool isAllowed(std::uint32_t from, std::uint32_t to, Targets& targets) const;
    void plan(std::uint32_t place);
    void collapse(const Step& step, const Targets& targets);

    const MeshLevel& surface_;
    Wedges wedges_;
    Box box_;
    double extent_;                                   ///< that lengths are measured by: the diagonal
    Appearance appearance_;                           ///< of all but the UVs that are in `points_`
    std::vector<Point5> points_;                      ///< of each wedge
    std::vector<Quadric> quadrics_;                   ///< of each wedge
    AttributeQuadrics attributes_;
    std::vector<glm::uvec3> triangles_;               ///< of wedges
    std::vector<bool> dead_;                          ///< of each triangle
    std::vector<std::vector<std::uint32_t>> around_;  ///< triangles of each place, some of them dead
    std::vector<bool> held_;                          ///< places that stay
    std::vector<std::uint32_t> ages_;                 ///< of each place: steps found earlier are void
    std::priority_queue<Step> steps_;
    std::size_t alive_ = 0;
};

}  // namespace lodestir
