// SPDX-License-Identifier: MIT
// How far a coarser level is from the finest one: in space, both ways, in all that is seen, and from point to point of the same UV.
#pragma once
#include <framework/scene/bvh/triangle_tree.h>
#include <framework/scene/lod/appearance.h>
#include <framework/scene/lod/vertex_fit.h>

#include <optional>

namespace lodestir {

/// Distances in object units. Sampled, so that they are a little below the true maxima.
struct LodError {
    float toFinest = 0;    ///< largest distance of a point of the coarse level to the finest: spikes, chords
    float fromFinest = 0;  ///< largest distance of a point of the finest level to the coarse one: holes, what was cut off
    float distance() const { return glm::max(toFinest, fromFinest); }  ///< the two-sided (Hausdorff) distance
    /// The same in space and Appearance together: how far from a point of either level the other has one that looks like it.
    float appearance = 0;
    float largest() const { return glm::max(distance(), appearance); }

    // Between a point of the coarse level and the nearest of the finest level's points with the same UV; 0 without UVs.
    float uvMean = 0, uv99 = 0, uvLargest = 0;
    float uvLostCoarse = 0, uvLostFinest = 0;  ///< share of the area whose UV the other level does not have
};

/// The finest level, ready to have others held against it.
class LODESTIR_API LodReference {
public:
    explicit LodReference(const MeshLevel& finest);

    /// Measures triangles made of the finest level's own vertices, with colours and normals of their own or (empty) the finest level's. Points: for
    /// distances in space all vertices, all triangle centres, and 20,000 that are spread over each surface by area; for the rest those
    /// 20,000. The same ones every time.
    LodError measure(const std::vector<glm::uvec3>& coarse, const VertexFit& looks = {}) const;
    bool hasUvs() const { return !uvs_.empty(); }
    float radius() const { return radius_; }  ///< of a sphere around the middle of the bounds

private:
    const MeshLevel& finest_;
    TriangleTree surface_;
    Appearance appearance_;
    std::vector<glm::vec3> uvs_;  ///< (u, v, 0)
    std::optional<TriangleTree> chart_;
    float radius_ = 0;
};

/// The two-sided (Hausdorff) distance in space of each level to the first, object units; levels need not share vertices. Sampled at the points that
/// LodReference::measure takes.
LODESTIR_API std::vector<float> distancesToFinest(const std::vector<MeshLevel>& levels);

/// UVs that tell points apart: there are some, and they span an area.
LODESTIR_API bool hasUsefulUvs(const MeshLevel& level);

}  // namespace lodestir
