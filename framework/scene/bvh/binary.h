// SPDX-License-Identifier: MIT
// The binary tree of boxes from which the 4-wide hierarchy is made: binned surface area heuristic, one reference a leaf.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

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

/// A box in half a cache line, with two words in the lanes that it leaves free: ten million of them are what a build waits for.
class PackedBounds {
public:
    PackedBounds() = default;
    PackedBounds(const Bounds& bounds, std::uint32_t first, std::uint32_t second = 0) : low_(bounds.low), high_(bounds.high) {
        low_[3] = std::bit_cast<float>(first);
        high_[3] = std::bit_cast<float>(second);
    }
    /// The words are no numbers: they must not take part in any arithmetic.
    Bounds bounds() const {
        using Words = std::int32_t __attribute__((vector_size(16)));
        constexpr Words box{-1, -1, -1, 0};
        return {Lanes(Words(low_) & box), Lanes(Words(high_) & box)};
    }
    std::uint32_t first() const { return std::bit_cast<std::uint32_t>(low_[3]); }
    std::uint32_t second() const { return std::bit_cast<std::uint32_t>(high_[3]); }

private:
    Lanes low_, high_;
};

/// Something with a box: a triangle or an instance.
struct Reference : PackedBounds {
    Reference() = default;
    Reference(const Bounds& bounds, std::uint32_t index) : PackedBounds(bounds, index) {}
    std::uint32_t index() const { return first(); }
};

/// A node over more than one reference.
struct BinaryNode : PackedBounds {
    BinaryNode() = default;
    BinaryNode(const Bounds& bounds, std::uint32_t leftCount) : PackedBounds(bounds, leftCount) {}
    std::uint32_t leftCount() const { return first(); }  ///< references of its left child
};

/// A part of the tree: references [first, first + count). One of them is a leaf and has no node.
struct Subtree {
    std::size_t node = 0;
    std::uint32_t first = 0, count = 0;

    bool leaf() const { return count == 1; }
};

/// A node's left child stands beside it and its right child behind the left one's whole subtree, so a tree over n references has exactly n - 1
/// nodes and nobody needs to agree on where the next one goes.
struct BinaryTree {
    std::span<const Reference> references;  ///< in the order of the leaves
    std::unique_ptr<BinaryNode[]> nodes;    ///< the root first

    Subtree root() const { return {0, 0, std::uint32_t(references.size())}; }
    Bounds boundsOf(const Subtree& s) const { return s.leaf() ? references[s.first].bounds() : nodes[s.node].bounds(); }
    Subtree left(const Subtree& s) const { return {s.node + 1, s.first, nodes[s.node].leftCount()}; }
    Subtree right(const Subtree& s) const {
        const std::uint32_t left = nodes[s.node].leftCount();
        return {s.node + left, s.first + left, s.count - left};
    }
};

/// Sorts the references into leaf order and builds the tree over them (at least one). No leaf is deeper than `maxDepth` splits, which must
/// be at least log2 of their number: what would become deeper is split in halves, whatever that costs. Parallel; the result doesn't depend on
/// the number of cores.
BinaryTree buildBinaryTree(std::span<Reference> references, int maxDepth);

}  // namespace lodestir::bvh
