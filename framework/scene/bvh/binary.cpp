// SPDX-License-Identifier: MIT
// Splits by the surface area heuristic in bins: Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007.
#include <framework/core/tasks.h>
#include <framework/scene/bvh/binary.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <mutex>

namespace lodestir::bvh {
namespace {

constexpr int binCount = 16;
constexpr std::size_t sweepLimit = 8;         // up to here every split is tried: cheaper than clearing the bins
constexpr std::size_t parallelBins = 65536;   // references that are worth being binned by all cores
constexpr std::size_t parallelNodes = 16384;  // references that are worth a task

struct Bin {
    Bounds bounds;
    std::uint32_t count = 0;

    void add(const Bin& other) {
        bounds.add(other.bounds);
        count += other.count;
    }
};

using Bins = std::array<std::array<Bin, binCount>, 3>;  // by axis

struct Extent {
    Bounds bounds;
    Bounds centers;  // twice the centres, which saves halving them

    void add(const Extent& other) {
        bounds.add(other.bounds);
        centers.add(other.centers);
    }
};

Lanes center(const Bounds& b) { return b.low + b.high; }

/// Runs body(chunk, sum) over all references, on all cores when it pays, and adds up the sums. Adding must not depend on the order.
template <class Sum, class Body> Sum gather(std::span<const Reference> references, const Body& body) {
    Sum total;
    if (references.size() < parallelBins) {
        body(references, total);
        return total;
    }
    std::mutex mutex;
    parallelFor(references.size(), parallelBins / 4, [&](std::size_t begin, std::size_t end) {
        Sum part;
        body(references.subspan(begin, end - begin), part);
        const std::lock_guard lock(mutex);
        if constexpr (requires { total.add(part); }) {
            total.add(part);
        } else {
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (std::size_t i = 0; i < binCount; ++i) total[axis][i].add(part[axis][i]);
        }
    });
    return total;
}

Extent extentOf(std::span<const Reference> references) {
    return gather<Extent>(references, [](std::span<const Reference> chunk, Extent& sum) {
        for (const Reference& r : chunk) {
            const Bounds bounds = r.bounds();
            sum.bounds.add(bounds);
            const Lanes c = center(bounds);
            sum.centers.add({c, c});
        }
    });
}

/// Maps a box's centre to its bin on each axis; an axis without extent puts all in bin 0.
struct Binning {
    Lanes base, scale;

    explicit Binning(const Bounds& centers) : base(centers.low) {
        const Lanes extent = centers.high - centers.low;
        for (int axis = 0; axis < 4; ++axis) scale[axis] = axis < 3 && extent[axis] > 0 ? binCount * 0.9999f / extent[axis] : 0;
        for (int axis = 0; axis < 3; ++axis)
            if (!(scale[axis] < std::numeric_limits<float>::max())) scale[axis] = 0;
    }
    auto operator()(const Bounds& b) const {
        using Indices = int __attribute__((vector_size(16)));
        return __builtin_convertvector((center(b) - base) * scale, Indices);
    }
};

struct Split {
    float cost = std::numeric_limits<float>::infinity();
    int axis = -1, bin = 0;  // bins up to `bin` go left
};

Split bestSplit(const Bins& bins) {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
        std::array<float, binCount> right{};  // cost of the bins from i on
        Bin sum;
        for (int i = binCount - 1; i > 0; --i) {
            sum.add(bins[axis][i]);
            right[i] = sum.count ? sum.bounds.area() * float(sum.count) : std::numeric_limits<float>::infinity();
        }
        sum = {};
        for (int i = 0; i + 1 < binCount; ++i) {
            sum.add(bins[axis][i]);
            if (sum.count == 0) continue;
            const float cost = sum.bounds.area() * float(sum.count) + right[i + 1];
            if (cost < best.cost) best = {cost, axis, i};
        }
    }
    return best;
}

/// Splits by trying every place on every axis; sorts the references along the best one and returns how many go left.
std::size_t sweep(std::span<Reference> references) {
    const std::size_t n = references.size();
    std::array<Reference, sweepLimit> sorted, best;
    std::size_t bestLeft = n / 2;
    float bestCost = std::numeric_limits<float>::infinity();
    std::copy(references.begin(), references.end(), best.begin());
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < n; ++i) {  // insertion sort: stable, and n is tiny
            std::size_t place = i;
            const float key = center(references[i].bounds())[axis];
            for (; place > 0 && center(sorted[place - 1].bounds())[axis] > key; --place) sorted[place] = sorted[place - 1];
            sorted[place] = references[i];
        }
        std::array<float, sweepLimit> right{};
        Bounds sum;
        for (std::size_t i = n - 1; i > 0; --i) {
            sum.add(sorted[i].bounds());
            right[i] = sum.area() * float(n - i);
        }
        sum = {};
        bool better = false;
        for (std::size_t left = 1; left < n; ++left) {
            sum.add(sorted[left - 1].bounds());
            const float cost = sum.area() * float(left) + right[left];
            if (cost < bestCost) {
                bestCost = cost;
                bestLeft = left;
                better = true;
            }
        }
        if (better) std::copy_n(sorted.begin(), n, best.begin());
    }
    std::copy_n(best.begin(), n, references.begin());
    return bestLeft;
}

/// Orders the references and returns how many go left, at least 1 and not all.
std::size_t split(std::span<Reference> references, const Extent& extent, bool heuristic) {
    if (references.size() == 2) return 1;
    if (heuristic && references.size() <= sweepLimit) return sweep(references);
    if (heuristic) {
        const Binning binning(extent.centers);
        const Bins bins = gather<Bins>(references, [&](std::span<const Reference> chunk, Bins& sum) {
            for (const Reference& r : chunk) {
                const Bounds bounds = r.bounds();
                const auto bin = binning(bounds);
                for (int axis = 0; axis < 3; ++axis) {
                    sum[axis][bin[axis]].bounds.add(bounds);
                    ++sum[axis][bin[axis]].count;
                }
            }
        });
        const Split best = bestSplit(bins);
        if (best.axis >= 0) {
            const auto middle = std::partition(references.begin(), references.end(),
                                               [&](const Reference& r) { return binning(r.bounds())[best.axis] <= best.bin; });
            return std::size_t(middle - references.begin());
        }
    }
    return references.size() / 2;  // all centres in one place, or too deep
}

struct Builder {
    std::span<Reference> references;
    BinaryNode* nodes;
    int maxDepth;

    void build(std::size_t node, std::size_t first, std::size_t count, int depth) const {
        if (count == 1) return;
        const std::span<Reference> mine = references.subspan(first, count);
        const Extent extent = extentOf(mine);
        // The worst split leaves count - 1 on one side, a level deeper; halves must still fit below.
        const std::size_t left = split(mine, extent, depth + 1 + int(std::bit_width(count - 1)) <= maxDepth);
        nodes[node] = {extent.bounds, std::uint32_t(left)};
        const auto buildLeft = [&] { build(node + 1, first, left, depth + 1); };
        const auto buildRight = [&] { build(node + left, first + left, count - left, depth + 1); };
        if (count >= parallelNodes) {
            parallelInvoke(buildLeft, buildRight);
        } else {
            buildLeft();
            buildRight();
        }
    }
};

}  // namespace

BinaryTree buildBinaryTree(std::span<Reference> references, int maxDepth) {
    BinaryTree tree{references, std::make_unique_for_overwrite<BinaryNode[]>(references.size() - 1)};
    Builder{references, tree.nodes.get(), maxDepth}.build(0, 0, references.size(), 0);
    return tree;
}

}  // namespace lodestir::bvh
