// SPDX-License-Identifier: MIT
// Bounding volume hierarchies: 4-wide nodes of 64 bytes with 16-bit boxes on a per-mesh grid, built by binned SAH.
#pragma once
#include <framework/core/api.h>
#include <framework/scene/bvh/box.h>
#include <framework/shaders/world/world.h>

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace lodestir {

/// Node references: below 0x80000000 a node index; 0x80000000 | (count - 1) << 28 | masked << 27 | first: a leaf of 1..4
/// triangles, masked: one of them has a `mask`;
/// 0xd0000000: return from an instance; 0xe0000000 | index: an instance; 0xffffffff: none.
namespace bvh_ref {
inline constexpr std::uint32_t leaf = 0x80000000u, masked = 0x08000000u, back = 0xd0000000u, instance = 0xe0000000u, empty = 0xffffffffu;
}

/// Dword 2i holds word i of {X0..X3, Y0..Y3}, dword 2i + 1 word i of {Z0..Z3, C0..C3};
/// X, Y, Z = low | high << 16 of a child's box on the grid, C = child reference. An absent child has low > high.
struct BvhNode {
    std::array<std::uint32_t, 16> dwords;
};

/// v0, e1 = v1 - v0, e2 = v2 - v0 in grid steps from BvhGrid::origin(); then `mask`: material index + 1 where hits are to be tested against its
/// alpha mask, 0: opaque; then two spare words.
struct BvhTriangle {
    glm::vec3 v0, e1, e2;
    std::uint32_t mask = 0, spare0 = 0, spare1 = 0;
};
static_assert(sizeof(BvhNode) == 64 && sizeof(BvhTriangle) == 48);

/// Object space from a BVH's grid: object = base + scale * grid.
struct BvhGrid {
    glm::vec3 base{0}, scale{1};

    /// From where triangles are measured, axis by axis: the point of the grid nearest to the origin of object space, where floats are finest, and so are
    /// vertices (from a corner of wide ground, what stands in its middle would be placed no better than a ten-millionth of the width); the grid's
    /// middle where all of it is farther than half its width. So no vertex x is farther from there than |x|.
    LODESTIR_API glm::vec3 origin() const;
    /// The grid's base in steps from there.
    glm::vec3 boxes() const { return (base - origin()) / scale; }
};

struct Bvh {
    glm::vec3 gridBase{0}, gridScale{1};      ///< object = base + scale * grid
    std::uint32_t root = bvh_ref::empty;      ///< relative to this BVH's own nodes and triangles
    std::vector<BvhNode> nodes;
    std::vector<std::uint32_t> order;         ///< BVH order -> input triangle
};

/// Nodes on the way from the root to any leaf, at most. Traversal keeps up to three references for each and one below them: `bvhStack` slots.
inline constexpr int bvhDepth = 21, bvhStack = 64;

/// A reference as it reads when its BVH's nodes and triangles stand behind others in shared arrays. An empty BVH becomes bvh_ref::back,
/// from which traversal returns at once, so the result may always stand in a table of roots.
LODESTIR_API std::uint32_t relocated(std::uint32_t reference, std::size_t firstNode, std::size_t firstTriangle);
/// Writes the nodes with their references relocated; returns the relocated root. Error when a triangle's number needs more than 27 bits.
LODESTIR_API std::uint32_t placeNodes(const Bvh& bvh, std::size_t firstNode, std::size_t firstTriangle, std::span<BvhNode> out);
/// The same behind the nodes of others.
LODESTIR_API std::uint32_t appendNodes(const Bvh& bvh, std::vector<BvhNode>& nodes, std::size_t firstTriangle);

/// Where one BVH lies in arrays that it shares with others (see appendNodes).
struct BvhRange {
    std::size_t firstNode = 0, nodes = 0, firstTriangle = 0, triangles = 0;
};
/// The triangles of one mesh level. All levels of a mesh share one `grid` box (the union of their bounds), because an instance has one
/// transform into it; a default Box means the level's own bounds. `masks` (per triangle, see BvhTriangle::mask) may be empty.
struct BvhInput {
    std::span<const glm::vec3> positions;
    std::span<const glm::uvec3> triangles;
    std::span<const std::uint32_t> masks = {};
    Box grid = {};
};
/// Builds the hierarchy of one mesh level. Parallel, the same bits for any core count. Triangles with a corner that isn't finite
/// (or beyond 1e18) can't be hit and are left out of `order`. Error from 2^27 triangles on.
LODESTIR_API Bvh buildBvh(const BvhInput& input);
/// The triangles of a hierarchy that was built of the same input, in its order.
LODESTIR_API void placeTriangles(const BvhInput& input, const Bvh& bvh, std::span<BvhTriangle> out);
/// buildBvh, kept in the cache folder by content where building takes longer than reading (from 16384 triangles on).
LODESTIR_API Bvh cachedBvh(const BvhInput& input);

/// Fits a BVH in shared arrays to vertices that moved: its triangles and boxes are made anew, the tree stays as it was built. `corners` has
/// three vertices per triangle of the shared array. Triangles with a corner that isn't finite can't be hit. Returns the grid made for `box`.
LODESTIR_API BvhGrid refitBvh(std::span<BvhNode> nodes, std::span<BvhTriangle> triangles, const BvhRange& range,
                              std::span<const PrimitiveRecord> corners, std::span<const glm::vec4> positions, const Box& box);

/// How traversal enters an instance of meshes that are built on this grid.
LODESTIR_API TraceInstance traceInstance(std::uint32_t mesh, const BvhGrid& grid, const glm::mat4& toWorld);
/// What InstanceRecord.rounding holds: |M^-1| |t|, and the largest sum of a row of |M^-1| |M| - 1, which is 0 where no axis is turned or sheared.
LODESTIR_API glm::vec4 traceRounding(const glm::mat4& toWorld);
/// Builds the hierarchy over boxes; leaves are instance references (bvh_ref::instance | box). order = boxes in the order of the
/// leaves. Boxes that are empty or not finite are left out; none left: root is bvh_ref::empty.
LODESTIR_API Bvh buildTopLevel(std::span<const Box> boxes);

}  // namespace lodestir
