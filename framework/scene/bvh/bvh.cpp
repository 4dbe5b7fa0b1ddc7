// SPDX-License-Identifier: MIT
// Collapses the binary tree to 4-wide nodes at the least expected cost and quantises their boxes.
#include <framework/core/error.h>
#include <framework/core/tasks.h>
#include <framework/scene/bvh/bvh.h>
#include <framework/scene/bvh/binary.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace lodestir {
namespace {

using bvh::BinaryTree;
using bvh::Bounds;
using bvh::Lanes;
using bvh::Reference;
using bvh::Subtree;

// Cost of testing one triangle, in visits to a node, as measured for packets on lavapipe (docs/rays.md).
constexpr float triangleCost = 0.3f;
constexpr std::size_t maxTriangles = std::size_t(1) << 27;  // bits of a leaf reference that hold its first triangle
constexpr float farthest = 1e18f;                           // squares of coordinates must stay finite
constexpr std::size_t parallelNodes = 32768;                // nodes of a binary subtree that are worth a task

// The grid is wider than the mesh by this many steps on each side, and a box is wider than its content by `boxMargin` before it is rounded
// outwards: that covers the rounding of `bound * inverse + offset` in traversal for origins up to a million steps away.
constexpr float gridMargin = 2, gridSteps = 65535, boxMargin = 0.25f;

/// Grid steps of the axes: object = base + scale * grid.
struct Grid {
    glm::vec3 base{0}, scale{1};

    explicit Grid(const Bounds& bounds) {
        const Lanes extent = bounds.high - bounds.low, reach = bvh::larger(bounds.high, -bounds.low);
        const float largest = std::max({extent[0], extent[1], extent[2], 1e-18f});
        for (int axis = 0; axis < 3; ++axis) {
            // Steps stay above what floats resolve: a thousandth of the largest extent's, and four units in the last place of coordinates.
            const float span = std::max({extent[axis], largest * 1e-3f, reach[axis] * 0x1p-22f * gridSteps});
            scale[axis] = span / (gridSteps - 2 * gridMargin);
            base[axis] = bounds.low[axis] - gridMargin * scale[axis];
        }
    }
    std::uint32_t quantise(float low, float high, int axis) const {
        const double step = 1.0 / double(scale[axis]);
        const double l = std::floor((double(low) - double(base[axis])) * step - boxMargin);
        const double h = std::ceil((double(high) - double(base[axis])) * step + boxMargin);
        return std::uint32_t(std::clamp(l, 0.0, double(gridSteps))) | std::uint32_t(std::clamp(h, 0.0, double(gridSteps))) << 16;
    }
};

/// Where binary subtrees become leaves, and where nodes of the wide tree, at the least expected cost of a ray: Ylitie, Karras, Laine, "Efficient
/// incoherent ray traversal on GPUs through compressed wide BVHs", 2017, section 3.1.
class Collapse {
public:
    Collapse(const BinaryTree& tree, std::uint32_t maxLeaf)
        : tree_(tree), maxLeaf_(maxLeaf), choices_(std::make_unique_for_overwrite<Choice[]>(tree.references.size())) {
        nodes_ = choose(tree.root()).nodes[1];
    }

    std::size_t nodes() const { return nodes_; }
    bool leaf(const Subtree& s) const { return s.leaf() || choices_[s.node].leaf; }

    /// The subtrees that become the children of the wide node made of one.
    int children(const Subtree& s, std::array<Subtree, 4>& out) const {
        const int left = choices_[s.node].left4;
        int count = 0;
        gather(tree_.left(s), left, out, count);
        gather(tree_.right(s), 4 - left, out, count);
        return count;
    }

private:
    /// How a subtree best becomes 2, 3 or 4 children of a wide node: how many of them its left side gets, or that the best for one child less is
    /// best for this many, too.
    struct Choice {
        static constexpr std::uint8_t fewer = 0;

        std::uint8_t leaf : 1;  // as one child: a leaf, not a node
        std::uint8_t left2 : 2, left3 : 2, left4 : 2;
    };
    /// By number of children, 1 to 3.
    struct Best {
        std::array<float, 4> cost;
        std::array<std::uint32_t, 4> nodes;  // wide ones
    };

    Best choose(const Subtree& s) {
        const float area = tree_.boundsOf(s).area();
        const float leafCost = s.count <= maxLeaf_ ? area * float(s.count) * triangleCost : std::numeric_limits<float>::infinity();
        Best best{};
        if (s.leaf()) {
            best.cost.fill(leafCost);
            return best;
        }
        const Subtree l = tree_.left(s), r = tree_.right(s);
        Best left, right;
        if (2 * std::size_t(s.count) > parallelNodes) {
            parallelInvoke([&] { left = choose(l); }, [&] { right = choose(r); });
        } else {
            left = choose(l);
            right = choose(r);
        }
        struct Distribution {
            int left;
            float cost;
            std::uint32_t nodes;
        };
        const auto distribute = [&](int roots) {
            Distribution found{1, left.cost[1] + right.cost[roots - 1], left.nodes[1] + right.nodes[roots - 1]};
            for (int n = 2; n < roots; ++n) {
                const float cost = left.cost[n] + right.cost[roots - n];
                if (cost < found.cost) found = {n, cost, left.nodes[n] + right.nodes[roots - n]};
            }
            return found;
        };
        Choice& c = choices_[s.node];
        const Distribution four = distribute(4), three = distribute(3), two = distribute(2);
        const float nodeCost = area + four.cost;
        c.left4 = std::uint8_t(four.left);
        c.leaf = leafCost <= nodeCost;
        best.cost[1] = std::min(leafCost, nodeCost);
        best.nodes[1] = c.leaf ? 0 : 1 + four.nodes;
        const auto take = [&](int roots, const Distribution& d) -> std::uint8_t {
            const bool isFewer = best.cost[roots - 1] <= d.cost;
            best.cost[roots] = isFewer ? best.cost[roots - 1] : d.cost;
            best.nodes[roots] = isFewer ? best.nodes[roots - 1] : d.nodes;
            return isFewer ? Choice::fewer : std::uint8_t(d.left);
        };
        c.left2 = take(2, two);
        c.left3 = take(3, three);
        return best;
    }

    void gather(const Subtree& s, int roots, std::array<Subtree, 4>& out, int& count) const {
        const auto leftOf = [&](int n) { return s.leaf() ? Choice::fewer : n == 2 ? choices_[s.node].left2 : choices_[s.node].left3; };
        while (roots > 1 && leftOf(roots) == Choice::fewer) --roots;
        if (roots == 1) {
            out[std::size_t(count++)] = s;
            return;
        }
        const int left = leftOf(roots);
        gather(tree_.left(s), left, out, count);
        gather(tree_.right(s), roots - left, out, count);
    }

    const BinaryTree& tree_;
    std::uint32_t maxLeaf_;
    std::unique_ptr<Choice[]> choices_;  // of each node
    std::size_t nodes_ = 0;
};

/// Every second level of the binary tree: half as deep, whatever it costs.
class PairCollapse {
public:
    PairCollapse(const BinaryTree& tree, std::uint32_t maxLeaf) : tree_(tree), maxLeaf_(maxLeaf) {}

    std::size_t nodes() const { return 0; }  // not counted before they are written: few trees are so deep
    bool leaf(const Subtree& s) const { return s.count <= maxLeaf_; }
    int children(const Subtree& s, std::array<Subtree, 4>& out) const {
        int count = 0;
        for (const Subtree& child : {tree_.left(s), tree_.right(s)}) {
            if (leaf(child)) {
                out[std::size_t(count++)] = child;
            } else {
                out[std::size_t(count++)] = tree_.left(child);
                out[std::size_t(count++)] = tree_.right(child);
            }
        }
        return count;
    }

private:
    const BinaryTree& tree_;
    std::uint32_t maxLeaf_;
};

/// Writes wide nodes depth first, so that a subtree lies in one stretch of memory.
template <class Shape, class LeafReference> class NodeWriter {
public:
    NodeWriter(const BinaryTree& tree, const Shape& shape, const Grid& grid, const LeafReference& leafReference, std::vector<BvhNode>& nodes)
        : tree_(tree), shape_(shape), grid_(grid), leafReference_(leafReference), nodes_(nodes) {}

    /// Returns the reference to what was written, or nothing usable once a path got longer than bvhDepth nodes (see `tooDeep`).
    std::uint32_t write(const Subtree& source, int depth = 1) {
        if (shape_.leaf(source)) return leafReference_(source);
        if (depth > bvhDepth) {
            tooDeep_ = true;
            return bvh_ref::empty;
        }
        std::array<Subtree, 4> children;
        const int count = shape_.children(source, children);
        const std::size_t place = nodes_.size();
        nodes_.emplace_back();
        BvhNode node;
        for (std::uint32_t i = 0; i < 4; ++i) {
            std::array<std::uint32_t, 3> box{0x0000ffffu, 0x0000ffffu, 0x0000ffffu};  // low above high: no ray enters
            std::uint32_t reference = bvh_ref::empty;
            if (int(i) < count) {
                const Bounds b = tree_.boundsOf(children[i]);
                for (int axis = 0; axis < 3; ++axis) box[std::size_t(axis)] = grid_.quantise(b.low[axis], b.high[axis], axis);
                reference = write(children[i], depth + 1);
            }
            node.dwords[2 * i] = box[0];
            node.dwords[2 * (4 + i)] = box[1];
            node.dwords[2 * i + 1] = box[2];
            node.dwords[2 * (4 + i) + 1] = reference;
        }
        nodes_[place] = node;
        return std::uint32_t(place);
    }
    bool tooDeep() const { return tooDeep_; }

private:
    const BinaryTree& tree_;
    const Shape& shape_;
    const Grid& grid_;
    const LeafReference& leafReference_;
    std::vector<BvhNode>& nodes_;
    bool tooDeep_ = false;
};

/// Sorts the references into leaf order and writes the nodes over them.
template <class LeafReference>
void writeNodes(std::span<Reference> references, const Bounds& wanted, std::uint32_t maxLeaf, const LeafReference& leafReference, Bvh& out) {
    const auto attempt = [&]<class Shape>(const BinaryTree& tree, const Shape& shape) {
        Bounds gridBounds = wanted;
        gridBounds.add(tree.boundsOf(tree.root()));
        const Grid grid(gridBounds);
        out.gridBase = grid.base;
        out.gridScale = grid.scale;
        out.nodes.clear();
        out.nodes.reserve(shape.nodes());
        NodeWriter writer(tree, shape, grid, leafReference, out.nodes);
        out.root = writer.write(tree.root());
        return !writer.tooDeep();
    };
    // Two binary levels make one wide level at worst, so that the second attempt can't fail. It serves input made to be deep, such as
    // sizes that shrink without end.
    const BinaryTree tree = bvh::buildBinaryTree(references, 2 * bvhDepth);
    if (!attempt(tree, Collapse(tree, maxLeaf))) attempt(tree, PairCollapse(tree, maxLeaf));
}

Bounds boundsOfPoint(glm::vec3 p) {
    const Lanes lanes{p.x, p.y, p.z, 0};
    return {lanes, lanes};
}

/// Empty unless low <= high on every axis.
Bounds boundsOfBox(const Box& box) {
    if (!glm::all(glm::lessThanEqual(box.low, box.high))) return {};
    return {boundsOfPoint(box.low).low, boundsOfPoint(box.high).high};
}

bool usable(glm::vec3 p) { return std::abs(p.x) < farthest && std::abs(p.y) < farthest && std::abs(p.z) < farthest; }

}  // namespace

std::uint32_t relocated(std::uint32_t reference, std::size_t firstNode, std::size_t firstTriangle) {
    if (reference == bvh_ref::empty) return bvh_ref::back;
    if (reference >= bvh_ref::back) return reference;
    return reference + std::uint32_t(reference < bvh_ref::leaf ? firstNode : firstTriangle);
}

std::uint32_t placeNodes(const Bvh& bvh, std::size_t firstNode, std::size_t firstTriangle, std::span<BvhNode> out) {
    if (firstTriangle + bvh.order.size() > maxTriangles)
        throw Error(fmt::format("the scene has more than {} triangles", maxTriangles), "show fewer levels or simpler meshes");
    parallelFor(bvh.nodes.size(), 16384, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            BvhNode node = bvh.nodes[n];
            for (std::size_t child = 9; child < 16; child += 2)
                if (node.dwords[child] != bvh_ref::empty) node.dwords[child] = relocated(node.dwords[child], firstNode, firstTriangle);
            out[n] = node;
        }
    });
    return relocated(bvh.root, firstNode, firstTriangle);
}

std::uint32_t appendNodes(const Bvh& bvh, std::vector<BvhNode>& nodes, std::size_t firstTriangle) {
    const std::size_t firstNode = nodes.size();
    nodes.resize(firstNode + bvh.nodes.size());
    return placeNodes(bvh, firstNode, firstTriangle, std::span(nodes).subspan(firstNode));
}

Bvh buildBvh(const BvhInput& input) {
    const auto& positions = input.positions;
    const auto& triangles = input.triangles;
    const auto& masks = input.masks;
    if (triangles.size() >= maxTriangles) {
        throw Error(fmt::format("a mesh of {} triangles is too large; at most {} fit", triangles.size(), maxTriangles - 1), "simplify it");
    }
    std::vector<Reference> references(triangles.size());
    parallelFor(triangles.size(), 16384, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const glm::uvec3 t = triangles[i];
            const bool inside = std::max({t.x, t.y, t.z}) < positions.size();
            Bounds b;
            if (inside && usable(positions[t.x]) && usable(positions[t.y]) && usable(positions[t.z]))
                for (int corner = 0; corner < 3; ++corner) b.add(boundsOfPoint(positions[t[corner]]));
            references[i] = {b, std::uint32_t(i)};
        }
    });
    std::erase_if(references, [](const Reference& r) { return r.bounds().empty(); });

    Bvh bvh;
    if (references.empty()) return bvh;
    const auto leafReference = [&](const Subtree& s) {
        const auto isMasked = [&](const Reference& r) { return !masks.empty() && masks[r.index()] != 0; };
        const bool masked = std::ranges::any_of(std::span(references).subspan(s.first, s.count), isMasked);
        return bvh_ref::leaf | (s.count - 1) << 28 | (masked ? bvh_ref::masked : 0) | s.first;
    };
    writeNodes(std::span(references), boundsOfBox(input.grid), 4, leafReference, bvh);
    bvh.order.reserve(references.size());
    for (const Reference& r : references) bvh.order.push_back(r.index());
    return bvh;
}

void placeTriangles(const BvhInput& input, const Bvh& bvh, std::span<BvhTriangle> out) {
    parallelFor(bvh.order.size(), 16384, [&](std::size_t begin, std::size_t end) {
        const glm::dvec3 base(BvhGrid{bvh.gridBase, bvh.gridScale}.origin()), scale(bvh.gridScale);
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t source = bvh.order[i];
            const glm::uvec3 t = input.triangles[source];
            const glm::dvec3 v0(input.positions[t.x]), v1(input.positions[t.y]), v2(input.positions[t.z]);
            out[i] = {.v0 = (v0 - base) / scale, .e1 = (v1 - v0) / scale, .e2 = (v2 - v0) / scale,
                      .mask = input.masks.empty() ? 0 : input.masks[source]};
        }
    });
}

BvhGrid refitBvh(std::span<BvhNode> nodes, std::span<BvhTriangle> triangles, const BvhRange& range, std::span<const PrimitiveRecord> corners,
                 std::span<const glm::vec4> positions, const Box& box) {
    Bounds wanted = boundsOfBox(box);
    if (wanted.empty()) wanted = boundsOfPoint(glm::vec3(0));
    const Grid grid(wanted);
    std::vector<Bounds> leaves(range.triangles), inner(range.nodes);
    parallelFor(range.triangles, 16384, [&](std::size_t begin, std::size_t end) {
        const glm::dvec3 base(BvhGrid{grid.base, grid.scale}.origin()), scale(grid.scale);
        for (std::size_t i = begin; i < end; ++i) {
            const PrimitiveRecord& c = corners[range.firstTriangle + i];
            const glm::vec3 v0(positions[c.v0]), v1(positions[c.v1]), v2(positions[c.v2]);
            BvhTriangle& triangle = triangles[range.firstTriangle + i];
            triangle.v0 = triangle.e1 = triangle.e2 = glm::vec3(0);
            if (!usable(v0) || !usable(v1) || !usable(v2)) continue;
            for (const glm::vec3& p : {v0, v1, v2}) leaves[i].add(boundsOfPoint(p));
            const glm::dvec3 corner(v0);
            triangle.v0 = (corner - base) / scale;
            triangle.e1 = (glm::dvec3(v1) - corner) / scale;
            triangle.e2 = (glm::dvec3(v2) - corner) / scale;
        }
    });
    for (std::size_t n = range.nodes; n-- > 0;) {  // children lie behind their parents
        BvhNode& node = nodes[range.firstNode + n];
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint32_t child = node.dwords[2 * (4 + i) + 1];
            if (child == bvh_ref::empty) continue;
            Bounds bounds;
            if (child < bvh_ref::leaf) {
                bounds = inner[child - range.firstNode];
            } else {
                const std::size_t first = (child & (bvh_ref::masked - 1)) - range.firstTriangle, count = (child >> 28 & 3) + 1;
                for (std::size_t t = first; t < first + count; ++t) bounds.add(leaves[t]);
            }
            std::array<std::uint32_t, 3> quantised{0x0000ffffu, 0x0000ffffu, 0x0000ffffu};
            if (!bounds.empty())
                for (int axis = 0; axis < 3; ++axis) quantised[std::size_t(axis)] = grid.quantise(bounds.low[axis], bounds.high[axis], axis);
            node.dwords[2 * i] = quantised[0];
            node.dwords[2 * (4 + i)] = quantised[1];
            node.dwords[2 * i + 1] = quantised[2];
            inner[n].add(bounds);
        }
    }
    return {grid.base, grid.scale};
}

Bvh buildTopLevel(std::span<const Box> boxes) {
    std::vector<Reference> references;
    references.reserve(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Box& box = boxes[i];
        if (!usable(box.low) || !usable(box.high) || boundsOfBox(box).empty()) continue;
        references.push_back({boundsOfBox(box), std::uint32_t(i)});
    }
    Bvh bvh;
    if (references.empty()) return bvh;
    writeNodes(std::span(references), Bounds(), 1, [&](const Subtree& s) { return bvh_ref::instance | references[s.first].index(); }, bvh);
    for (const Reference& r : references) bvh.order.push_back(r.index());
    return bvh;
}

glm::vec3 BvhGrid::origin() const {
    const glm::vec3 half = 0.5f * gridSteps * scale, nearest = glm::clamp(glm::vec3(0), base, base + 2.0f * half);
    return glm::mix(nearest, base + half, glm::greaterThanEqual(glm::abs(nearest), half));
}

TraceInstance traceInstance(std::uint32_t mesh, const BvhGrid& grid, const glm::mat4& toWorld) {
    const glm::dmat4 exact(toWorld);
    const glm::dmat3 toObject = glm::inverse(glm::dmat3(exact));
    const glm::dvec3 origin(exact * glm::dvec4(grid.origin(), 1));
    TraceInstance instance{};
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 row(toObject[0][axis], toObject[1][axis], toObject[2][axis]);
        instance.toGrid[axis] = glm::vec4(row / double(grid.scale[axis]), origin[axis]);
    }
    instance.mesh = mesh;
    instance.boxes = grid.boxes();
    return instance;
}

glm::vec4 traceRounding(const glm::mat4& toWorld) {
    const auto sizes = [](const glm::dmat3& m) { return glm::dmat3(glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])); };
    const glm::dmat3 linear(toWorld), inverse = sizes(glm::inverse(linear));
    const glm::dvec3 sums = inverse * (sizes(linear) * glm::dvec3(1));
    const double mixed = std::max({sums.x, sums.y, sums.z}) - 1;
    return glm::vec4(inverse * glm::abs(glm::dvec3(toWorld[3])), mixed > 1e-6 ? mixed : 0);
}

}  // namespace lodestir
