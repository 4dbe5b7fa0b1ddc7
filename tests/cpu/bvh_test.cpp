// SPDX-License-Identifier: MIT
// The hierarchy: nothing is lost in it, no box is too small for its content, no path is too long for the stack that walks it.
#include "triangle_soup.h"

#include <framework/core/files.h>
#include <framework/core/tasks.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <numeric>
#include <string>
#include <unistd.h>

namespace lodestir::test {
namespace {

struct Child {
    glm::vec3 low, high;  ///< grid steps
    std::uint32_t reference;
};

Child childOf(const BvhNode& node, std::size_t i) {
    const glm::uvec3 box(node.dwords[2 * i], node.dwords[2 * (4 + i)], node.dwords[2 * i + 1]);
    return {glm::vec3(box & 0xffffu), glm::vec3(box >> 16u), node.dwords[2 * (4 + i) + 1]};
}

struct Leaf {
    std::uint32_t first, count;
    bool masked;
};
Leaf leafOf(std::uint32_t reference) {
    return {reference & (bvh_ref::masked - 1), ((reference >> 28) & 3) + 1, (reference & bvh_ref::masked) != 0};
}

/// Of the boxes, in the steps from the origin that triangles are in.
/// A hierarchy with its triangles.
struct Built : Bvh {
    std::vector<BvhTriangle> triangles;
};

Built withTriangles(const BvhInput& input, const Bvh& bvh) {
    Built built{bvh, std::vector<BvhTriangle>(bvh.order.size())};
    placeTriangles(input, bvh, built.triangles);
    return built;
}

glm::vec3 boxesOf(const Bvh& bvh) { return BvhGrid{bvh.gridBase, bvh.gridScale}.boxes(); }

/// Where a ray in grid space, measured like triangles, meets the nearest triangle: visits every child whose box the ray passes before the nearest hit
/// so far, in float arithmetic like the shaders'.
TestHit walk(const Built& bvh, TestRay ray) {
    TestHit best;
    const auto slope = 1.0f / glm::mix(ray.direction, glm::vec3(1e-18f), glm::lessThan(glm::abs(ray.direction), glm::vec3(1e-18f)));
    const glm::vec3 offset = (boxesOf(bvh) - ray.origin) * slope;
    const std::function<void(std::uint32_t)> visit = [&](std::uint32_t reference) {
        if (reference == bvh_ref::empty) return;
        if (reference >= bvh_ref::leaf) {
            const Leaf leaf = leafOf(reference);
            for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
                const BvhTriangle& t = bvh.triangles[i];
                const float distance = meet<float>(ray.origin, ray.direction, t.v0, t.e1, t.e2);
                if (distance < best.t) best = {distance, bvh.order[i]};
            }
            return;
        }
        for (std::size_t i = 0; i < 4; ++i) {
            const Child child = childOf(bvh.nodes[reference], i);
            const glm::vec3 a = child.low * slope + offset, b = child.high * slope + offset;
            const glm::vec3 enter = glm::min(a, b), leave = glm::max(a, b);
            if (std::max({enter.x, enter.y, enter.z, 0.0f}) <= std::min({leave.x, leave.y, leave.z, best.t})) visit(child.reference);
        }
    };
    visit(bvh.root);
    return best;
}

TestHit tryAll(const Built& bvh, TestRay ray) {
    TestHit best;
    for (std::size_t i = 0; i < bvh.triangles.size(); ++i) {
        const BvhTriangle& t = bvh.triangles[i];
        const float distance = meet<float>(ray.origin, ray.direction, t.v0, t.e1, t.e2);
        if (distance < best.t) best = {distance, bvh.order[i]};
    }
    return best;
}

/// Fails unless each triangle is in one leaf, inside all boxes on the way to it, and no way is longer than bvhDepth nodes.
void expectSound(const Built& bvh, std::size_t triangles) {
    ASSERT_EQ(bvh.triangles.size(), triangles);
    ASSERT_EQ(bvh.order.size(), triangles);
    std::vector<int> seen(triangles, 0);
    int deepest = 0, tooSmall = 0;
    std::size_t nodes = 0;
    const std::function<void(std::uint32_t, glm::vec3, glm::vec3, int)> visit = [&](std::uint32_t reference, glm::vec3 low, glm::vec3 high, int depth) {
        if (reference >= bvh_ref::leaf) {
            ASSERT_LT(reference, bvh_ref::back);
            const Leaf leaf = leafOf(reference);
            for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
                ASSERT_LT(i, triangles);
                ++seen[i];
                const BvhTriangle& t = bvh.triangles[i];
                // 0.2 of a step must be left for the rounding of traversal.
                for (const glm::vec3 corner : {t.v0 - boxesOf(bvh), t.v0 + t.e1 - boxesOf(bvh), t.v0 + t.e2 - boxesOf(bvh)})
                    tooSmall += glm::any(glm::lessThan(corner - 0.2f, low)) || glm::any(glm::greaterThan(corner + 0.2f, high));
            }
            return;
        }
        ASSERT_LT(reference, bvh.nodes.size());
        ++nodes;
        deepest = std::max(deepest, depth);
        int children = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const Child child = childOf(bvh.nodes[reference], i);
            if (child.reference == bvh_ref::empty) {
                EXPECT_TRUE(glm::all(glm::greaterThan(child.low, child.high)));
                continue;
            }
            ++children;
            visit(child.reference, glm::max(low, child.low), glm::min(high, child.high), depth + 1);
        }
        EXPECT_GE(children, 2);
    };
    if (triangles > 0) visit(bvh.root, glm::vec3(-1e30f), glm::vec3(1e30f), 1);
    EXPECT_EQ(nodes, bvh.nodes.size());
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), std::ptrdiff_t(triangles));
    EXPECT_EQ(tooSmall, 0);
    EXPECT_LE(deepest, bvhDepth);
    EXPECT_LE(3 * bvhDepth + 1, bvhStack);
}

/// Fails unless rays find in the tree what they find without it.
void expectSameHits(const Built& bvh, std::uint32_t seed, int rays) {
    Draws draws(seed);
    int hits = 0;
    for (int i = 0; i < rays; ++i) {
        const glm::vec3 origin = boxesOf(bvh) + draws.point(-20000, 90000), target = boxesOf(bvh) + draws.point(0, 65535);
        TestRay ray{origin, target - origin};
        if (i % 4 == 0) ray.direction[i / 4 % 3] = 0;  // along a plane of the grid
        const TestHit tree = walk(bvh, ray), all = tryAll(bvh, ray);
        ASSERT_EQ(tree.t, all.t) << "ray " << i;
        hits += std::isfinite(all.t);
    }
    EXPECT_GT(hits, rays / 20);
}

Built build(const BvhInput& input) { return withTriangles(input, buildBvh(input)); }
Built build(const Soup& soup) { return build(BvhInput{soup.positions, soup.triangles}); }
Built cached(const Soup& soup) {
    const BvhInput input{soup.positions, soup.triangles};
    return withTriangles(input, cachedBvh(input));
}

bool sameBits(const Built& a, const Built& b) {
    const auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() && (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]) == 0);
    };
    return a.root == b.root && a.gridBase == b.gridBase && a.gridScale == b.gridScale && same(a.nodes, b.nodes) && same(a.triangles, b.triangles) &&
           same(a.order, b.order);
}

TEST(Bvh, RandomSoupsAreSound) {
    for (const std::size_t count : {1, 2, 3, 4, 5, 7, 8, 9, 17, 100, 5000}) {
        for (const float size : {0.001f, 0.05f, 1.0f}) {
            const Soup soup = randomSoup(std::uint32_t(count), count, size);
            const Built bvh = build(soup);
            SCOPED_TRACE(testing::Message() << count << " triangles of size " << size);
            expectSound(bvh, count);
        }
    }
}

TEST(Bvh, FindsWhatBruteForceFinds) {
    expectSameHits(build(randomSoup(1, 3000, 0.08f)), 2, 2000);
    expectSameHits(build(randomSoup(3, 300, 1.0f)), 4, 2000);
}

// A triangle's own corners are where a box that is a step too small would lose it.
TEST(Bvh, RaysThroughCornersAreNotLost) {
    const Built bvh = build(randomSoup(5, 2000, 0.03f));
    Draws draws(6);
    int lost = 0;
    for (const BvhTriangle& t : bvh.triangles) {
        const glm::vec3 at = t.v0 + 0.001f * t.e1 + 0.001f * t.e2, origin = boxesOf(bvh) + draws.point(-20000, 90000);
        const TestRay ray{origin, at - origin};
        lost += walk(bvh, ray).t != tryAll(bvh, ray).t;
    }
    EXPECT_EQ(lost, 0);
}

TEST(Bvh, TrianglesAreInGridSpace) {
    const Soup soup = randomSoup(7, 500, 0.1f);
    const Built bvh = build(soup);
    const glm::vec3 origin = BvhGrid{bvh.gridBase, bvh.gridScale}.origin();
    for (std::size_t i = 0; i < bvh.order.size(); ++i) {
        const glm::uvec3 corners = soup.triangles[bvh.order[i]];
        const BvhTriangle& t = bvh.triangles[i];
        const glm::vec3 grid[] = {t.v0, t.v0 + t.e1, t.v0 + t.e2};
        for (int c = 0; c < 3; ++c) {
            const glm::vec3 object = origin + bvh.gridScale * grid[c], box = grid[c] - boxesOf(bvh);
            EXPECT_LT(glm::distance(object, soup.positions[corners[c]]), 1e-6f);
            EXPECT_TRUE(glm::all(glm::greaterThan(box, glm::vec3(1))) && glm::all(glm::lessThan(box, glm::vec3(65534))));
        }
    }
}

// Vertices near the origin of object space keep their precision however wide the mesh is, and those far from it that of their distance to the mesh.
TEST(Bvh, WideMeshesKeepWhatIsSmallInTheirMiddle) {
    Soup wide;
    wide.add({-1e5f, 0, 1e5f}, {1e5f, 0, 1e5f}, {1e5f, 0, -1e5f});
    wide.add({0.001f, 0.02f, 0.003f}, {0.004f, 0.02f, 0.003f}, {0.001f, 0.02f, 0.008f});
    Soup far;
    far.add({8297640, 533512, 412345}, {8297650, 533512, 412345}, {8297640, 533512, 412355});
    far.add({8297641, 533513, 412346}, {8297642, 533513, 412346}, {8297641, 533513, 412347});
    for (const Soup& soup : {wide, far}) {
        const Built bvh = build(soup);
        const glm::dvec3 origin(BvhGrid{bvh.gridBase, bvh.gridScale}.origin()), scale(bvh.gridScale);
        for (std::size_t i = 0; i < 2; ++i) {
            const glm::dvec3 corner(soup.positions[soup.triangles[bvh.order[i]].x]), stored = origin + scale * glm::dvec3(bvh.triangles[i].v0);
            for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(stored[axis], corner[axis], 0x1p-23 * std::abs(corner[axis] - origin[axis]));
        }
    }
}

TEST(Bvh, EmptyAndDegenerateInput) {
    const Built nothing = build(Soup());
    EXPECT_EQ(nothing.root, bvh_ref::empty);
    EXPECT_TRUE(nothing.nodes.empty() && nothing.triangles.empty() && nothing.order.empty());

    Soup points, copies, plane, line;
    Draws draws(8);
    for (int i = 0; i < 1000; ++i) {
        points.add({1, 2, 3}, {1, 2, 3}, {1, 2, 3});
        copies.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
        const glm::vec3 at = draws.point();
        plane.add({at.x, 5, at.z}, {at.x + 0.1f, 5, at.z}, {at.x, 5, at.z + 0.1f});
        line.add({at.x, 0, 0}, {at.x + 0.1f, 0, 0}, {at.y, 0, 0});
    }
    for (const Soup* soup : {&points, &copies, &plane, &line}) expectSound(build(*soup), 1000);

    const Built flat = build(plane);
    const TestRay down{{30000, 60000, 30000}, {0.001f, -60000, 0.001f}};
    EXPECT_EQ(walk(flat, down).t, tryAll(flat, down).t);
    EXPECT_TRUE(std::isfinite(walk(flat, down).t));
}

// Sizes that shrink by half each time make the heuristic cut off one triangle at a time.
TEST(Bvh, NoPathIsLongerThanTheStack) {
    Soup chain;
    for (int i = 0; i < 110; ++i) {
        const float at = std::ldexp(1.0f, -i), size = at * 0.1f;
        chain.add({at, 0, 0}, {at + size, size, 0}, {at, size, size});
    }
    expectSound(build(chain), chain.triangles.size());
    Soup nested = randomSoup(9, 4000, 0.01f);
    for (int i = 0; i < 120; ++i) {
        const float size = std::ldexp(1.0f, i / 3 - 20);
        nested.add({-size, -size, 0}, {size, 0, size}, {0, size, -size});
    }
    expectSound(build(nested), nested.triangles.size());
}

TEST(Bvh, WhatIsNotFiniteIsLeftOut) {
    Soup soup = randomSoup(10, 100, 0.1f);
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    soup.add({nan, 0, 0}, {1, 0, 0}, {0, 1, 0});
    soup.add({0, 0, 0}, {1, infinity, 0}, {0, 1, 0});
    soup.add({0, 0, 0}, {1, 0, 0}, {0, 1, -3e38f});
    soup.triangles.emplace_back(0, 1, 100000);
    const Built bvh = build(soup);
    expectSound(bvh, 100);
    EXPECT_LT(*std::max_element(bvh.order.begin(), bvh.order.end()), 100u);
    for (const TestRay ray : {TestRay{{nan, 0, 0}, {1, 0, 0}}, TestRay{{0, 0, 0}, {nan, nan, nan}}, TestRay{{0, 0, 0}, {0, 0, 0}}})
        EXPECT_EQ(walk(bvh, ray).triangle, bvh_ref::empty);
}

TEST(Bvh, LeavesKnowOfMasks) {
    const Soup soup = randomSoup(11, 1000, 0.05f);
    std::vector<std::uint32_t> masks(1000, 0);
    for (std::size_t i = 0; i < masks.size(); i += 7) masks[i] = std::uint32_t(i) + 1;
    const Built bvh = build({soup.positions, soup.triangles, masks});
    expectSound(bvh, 1000);
    for (std::size_t i = 0; i < bvh.order.size(); ++i) EXPECT_EQ(bvh.triangles[i].mask, masks[bvh.order[i]]);
    int leaves = 0;
    for (const BvhNode& node : bvh.nodes) {
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint32_t reference = childOf(node, i).reference;
            if (reference < bvh_ref::leaf || reference == bvh_ref::empty) continue;
            const Leaf leaf = leafOf(reference);
            const auto first = bvh.triangles.begin() + leaf.first;
            EXPECT_EQ(leaf.masked, std::any_of(first, first + leaf.count, [](const BvhTriangle& t) { return t.mask != 0; }));
            ++leaves;
        }
    }
    EXPECT_GT(leaves, 250);
}

TEST(Bvh, LevelsShareAGrid) {
    const Soup fine = randomSoup(12, 500, 0.1f), coarse = randomSoup(13, 20, 0.02f);
    const Box box{glm::vec3(-1), glm::vec3(2)};
    const Built a = build({fine.positions, fine.triangles, {}, box}), b = build({coarse.positions, coarse.triangles, {}, box});
    EXPECT_EQ(a.gridBase, b.gridBase);
    EXPECT_EQ(a.gridScale, b.gridScale);
    expectSound(a, 500);
    expectSound(b, 20);
}

// Inside parallelInvoke a build finds no idle core, and works alone.
TEST(Bvh, SameBitsForAnyNumberOfCores) {
    const Soup soup = randomSoup(14, 100000, 0.01f);
    const Built once = build(soup);
    Built a, b;
    parallelInvoke([&] { a = build(soup); }, [&] { b = build(soup); });
    EXPECT_TRUE(sameBits(once, a));
    EXPECT_TRUE(sameBits(once, b));
}

class BvhCache : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() / ("lodestir_bvh_test_" + std::to_string(getpid()));
        setenv("LODESTIR_CACHE", folder_.c_str(), 1);
    }
    void TearDown() override {
        unsetenv("LODESTIR_CACHE");
        std::filesystem::remove_all(folder_);
    }
    std::vector<Path> files() const {
        std::vector<Path> found;
        if (!std::filesystem::exists(folder_)) return found;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_))
            if (entry.is_regular_file()) found.push_back(entry.path());
        return found;
    }
    Path folder_;
};

TEST_F(BvhCache, GivesBackWhatWasBuilt) {
    Soup soup = randomSoup(15, 20000, 0.02f);
    const Built built = build(soup), first = cached(soup);
    ASSERT_EQ(files().size(), 1u);
    const auto written = std::filesystem::last_write_time(files()[0]);
    const Built second = cached(soup);
    EXPECT_EQ(std::filesystem::last_write_time(files()[0]), written);
    EXPECT_TRUE(sameBits(built, first));
    EXPECT_TRUE(sameBits(built, second));

    soup.positions[7].x += 0.25f;
    EXPECT_TRUE(sameBits(build(soup), cached(soup)));
    EXPECT_EQ(files().size(), 2u);
}

TEST_F(BvhCache, DamagedFilesAreBuiltAnew) {
    const Soup soup = randomSoup(16, 20000, 0.02f);
    const Built built = cached(soup);
    const Path file = files().at(0);
    const std::vector<std::byte> good = readBytes(file);

    std::vector<std::byte> flipped = good;
    flipped[good.size() / 2] ^= std::byte(1);
    const std::vector<std::byte> cut(good.begin(), good.begin() + std::ptrdiff_t(good.size() / 3));
    for (const std::vector<std::byte>& bad : {flipped, cut, std::vector<std::byte>(3), std::vector<std::byte>()}) {
        writeFile(file, bad);
        EXPECT_TRUE(sameBits(built, cached(soup)));
        EXPECT_EQ(readBytes(file), good);
    }
}

TEST_F(BvhCache, SmallMeshesAreNotWritten) {
    const Soup soup = randomSoup(17, 100, 0.1f);
    EXPECT_TRUE(sameBits(build(soup), cached(soup)));
    EXPECT_TRUE(files().empty());
}

TEST(TopLevel, HoldsEachBoxOnce) {
    Draws draws(18);
    for (const std::size_t count : {1, 2, 3, 5, 400}) {
        std::vector<Box> boxes;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 low = draws.point(-10, 10), size = draws.point(0, 2);
            boxes.push_back({low, low + size});
        }
        const Bvh top = buildTopLevel(boxes);
        std::vector<int> seen(count, 0);
        const std::function<void(std::uint32_t, glm::vec3, glm::vec3)> visit = [&](std::uint32_t reference, glm::vec3 low, glm::vec3 high) {
            if (reference >= bvh_ref::instance) {
                const std::uint32_t box = reference & 0x1fffffff;
                ASSERT_LT(box, count);
                ++seen[box];
                EXPECT_TRUE(glm::all(glm::lessThanEqual(low, boxes[box].low)) && glm::all(glm::greaterThanEqual(high, boxes[box].high)));
                return;
            }
            ASSERT_LT(reference, top.nodes.size());
            for (std::size_t i = 0; i < 4; ++i) {
                const Child child = childOf(top.nodes[reference], i);
                if (child.reference == bvh_ref::empty) continue;
                visit(child.reference, top.gridBase + top.gridScale * child.low, top.gridBase + top.gridScale * child.high);
            }
        };
        visit(top.root, glm::vec3(-1e30f), glm::vec3(1e30f));
        EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), std::ptrdiff_t(count));
        EXPECT_EQ(top.order.size(), count);
    }
}

TEST(TopLevel, LeavesOutWhatIsEmpty) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(buildTopLevel({}).root, bvh_ref::empty);
    const std::vector<Box> boxes{Box{}, {{0, 0, 0}, {1, 1, 1}}, {{nan, 0, 0}, {1, 1, 1}}, {{0, 1, 0}, {1, 0, 1}}};
    EXPECT_EQ(buildTopLevel(boxes).root, bvh_ref::instance | 1);
    EXPECT_EQ(buildTopLevel(std::vector<Box>(5)).root, bvh_ref::empty);
}

TEST(Relocation, MovesNodesAndLeaves) {
    const Soup soup = randomSoup(21, 200, 0.1f);
    const Built bvh = build(soup);
    std::vector<BvhNode> nodes(10);
    const std::uint32_t root = appendNodes(bvh, nodes, 1000);
    ASSERT_EQ(nodes.size(), bvh.nodes.size() + 10);
    EXPECT_EQ(root, bvh.root + 10);
    for (std::size_t n = 0; n < bvh.nodes.size(); ++n) {
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint32_t before = childOf(bvh.nodes[n], i).reference, after = childOf(nodes[n + 10], i).reference;
            EXPECT_EQ(after, before == bvh_ref::empty ? before : before + (before < bvh_ref::leaf ? 10 : 1000));
        }
    }
    EXPECT_EQ(relocated(bvh_ref::empty, 5, 5), bvh_ref::back);
    EXPECT_EQ(relocated(bvh_ref::instance | 3, 5, 5), bvh_ref::instance | 3);
}

}  // namespace
}  // namespace lodestir::test
