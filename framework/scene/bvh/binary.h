// SPDX-License-Identifier: MIT
// The binary tree of boxes from which the 4-wide hierarchy is made: binned surface area heuristic, one reference a leaf.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace lodestir::bvh {

/// Four floats that are handled as one; a box uses three of them.
using Lanes = float __attribute__((vector_size(16)));

inline Lanes smaller(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes larger(Lanes a, Lanes b) { return a > b ? a : b; }

struct Bounds {
    Lanes low{1e30f, 1e30f, 1e30f, 0}, high{-1e30f, -1e30f, -1e30f, 0};

    void add(const Bounds& other) {
        low = smaller(low, other.low);
        high = larger(high, other.high);
    }
    bool empty() const { return low[0] > high[0]; }
    /// Half the surface; 0 for an empty box.
    float area() const {
        const Lanes d = high - low;
        return empty() ? 0 : d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
    }
};

/// Something with a box: a triangle or an instance.
struct Reference {
    Bounds bounds;
    std::uint32_t index = 0;
};

/// A node over `count` references has its left child beside it and its right child behind the left one's whole subtree, so a tree over n
/// references has exactly 2n - 1 nodes and nobody needs to agree on where the next one goes.
struct BinaryNode {
    Bounds bounds;
    std::uint32_t first, count, leftCount;  ///< references [first, first + count); leaf: count is 1

    bool leaf() const { return count == 1; }
};

struct BinaryTree {
    std::unique_ptr<BinaryNode[]> nodes;  ///< the root first
    std::size_t size = 0;

    static std::size_t left(std::size_t node) { return node + 1; }
    std::size_t right(std::size_t node) const { return node + 2 * std::size_t(nodes[node].leftCount); }
};

/// Sorts the references into leaf order and builds the tree over them (at least one). No leaf is deeper than `maxDepth` splits, which must
/// be at least log2 of their number: what would become deeper is split in halves, whatever that costs. Parallel; the result doesn't depend on
/// the number of cores.
BinaryTree buildBinaryTree(std::span<Reference> references, int maxDepth);

}  // namespace lodestir::bvh
