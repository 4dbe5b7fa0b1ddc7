// SPDX-License-Identifier: MIT
// If these fail, levels are measured and fitted against another part of the surface than the one that looks most like it.
#include <framework/scene/lod/appearance_tree.h>

#include <gtest/gtest.h>

#include <random>

namespace lodestir::test {
namespace {

TEST(AppearanceTree, FindsWhatTryingAllFinds) {
    std::mt19937 random(7);
    const auto unit = [&] { return float(random() & 0xffffff) / float(0x1000000); };
    MeshLevel level;
    for (std::uint32_t i = 0; i < 600; ++i) {
        level.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        const glm::vec3 middle(unit(), unit(), 0.01f * unit());  // many lie on each other and look otherwise
        const glm::vec2 chart(unit(), unit());
        const glm::vec3 side(unit() - 0.5f, unit() - 0.5f, unit() - 0.5f);
        for (int k = 0; k < 3; ++k) {
            level.positions.push_back(middle + 0.03f * glm::vec3(unit(), unit(), 0.1f * unit()));
            level.uv0.push_back(chart + 0.02f * glm::vec2(unit(), unit()));
            level.normals.push_back(glm::normalize(side + 0.1f * glm::vec3(unit(), unit(), unit())));
        }
    }
    const Appearance appearance(level, Appearance::all);
    ASSERT_EQ(appearance.size(), 5u);
    const TriangleTree boxes(level.positions, level.triangles);
    const AppearanceTree tree(boxes, level.positions, level.triangles, appearance);
    for (int i = 0; i < 400; ++i) {
        const glm::dvec3 place(unit(), unit(), 0.01 * unit());
        const auto like = appearance.of(std::uint32_t(random() % level.positions.size()));
        const std::vector<double> looks(like.begin(), like.end());
        const auto isEven = [](std::uint32_t triangle) { return triangle % 2 == 0; };
        NearestPoint least{.squaredDistance = std::numeric_limits<double>::infinity()};
        for (std::uint32_t t = 0; t < level.triangles.size(); t += 2) {
            const NearestPoint point = nearestOn(level.triangles[t], level.positions, appearance, place, looks);
            if (point.squaredDistance < least.squaredDistance) least = point, least.triangle = t;
        }
        const NearestPoint found = tree.nearest(place, looks, isEven);
        EXPECT_EQ(found.triangle, least.triangle);
        EXPECT_EQ(found.squaredDistance, least.squaredDistance);
        // Who has enough gets no more than that; who hasn't gets the least.
        const double distance = std::sqrt(least.squaredDistance);
        EXPECT_LE(tree.nearest(place, looks, isEven, 2 * distance).squaredDistance, 4 * least.squaredDistance);
        EXPECT_EQ(tree.nearest(place, looks, isEven, 0.5 * distance).squaredDistance, least.squaredDistance);
    }
    const NearestPoint nothing = tree.nearest(glm::dvec3(0), std::vector<double>(5, 0.0), [](std::uint32_t) { return false; });
    EXPECT_EQ(nothing.triangle, none);
    EXPECT_TRUE(std::isinf(nothing.squaredDistance));
}

}  // namespace
}  // namespace lodestir::test
