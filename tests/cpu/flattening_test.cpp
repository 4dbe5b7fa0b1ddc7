// SPDX-License-Identifier: MIT
// If these fail, what a node squeezes flat is not seen, is seen from the wrong side, or is no number.
#include <framework/scene/axes.h>
#include <framework/scene/deformation.h>
#include <framework/scene/flattening.h>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

using namespace lodestir;

namespace {

glm::dmat3 scaling(double x, double y, double z) { return {{x, 0, 0}, {0, y, 0}, {0, 0, z}}; }
const glm::dmat3 turned(glm::rotate(glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(1, 2, -1)), 1.1, glm::dvec3(0, 1, 1)));

/// A cube around the origin, on one node after another.
Scene cubeUnder(std::vector<Node> nodes) {
    Scene scene;
    scene.materials.emplace_back();
    Mesh& mesh = scene.meshes.emplace_back();
    MeshLevel& level = mesh.levels.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-0.5f, 0.5f}) {
            const auto first = std::uint32_t(level.positions.size());
            for (const glm::vec2 c : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
                glm::vec3 p, n(0);
                p[axis] = side;
                p[(axis + 1) % 3] = 0.5f * c.x;
                p[(axis + 2) % 3] = 0.5f * c.y;
                n[axis] = 2 * side;
                level.positions.push_back(p);
                level.normals.push_back(n);
            }
            const glm::uvec3 a(first, first + 1, first + 2), b(first, first + 2, first + 3);
            level.triangles.push_back(side > 0 ? a : glm::uvec3(a.x, a.z, a.y));
            level.triangles.push_back(side > 0 ? b : glm::uvec3(b.x, b.z, b.y));
            level.materials.insert(level.materials.end(), 2, 0);
        }
    }
    for (std::size_t i = 1; i < nodes.size(); ++i) nodes[i].parent = std::uint32_t(i - 1);
    scene.nodes = std::move(nodes);
    scene.instances.push_back({"cube", 0, std::uint32_t(scene.nodes.size() - 1)});
    return scene;
}

}  // namespace

TEST(Flattening, WhatIsFlat) {
    for (const glm::dmat3& outer : {glm::dmat3(1), turned}) {
        for (const glm::dmat3& inner : {glm::dmat3(1), turned}) {
            for (const double size : {1e-6, 1.0, 1e6}) {
                const auto flat = [&](double x, double y, double z) {
                    return flattens(outer * scaling(x, y, z) * size * inner, glm::dvec3(1));
                };
                EXPECT_TRUE(flat(1, 1, 0) && flat(2, 0, 1) && flat(0, 3, 1) && flat(1, 0, 0) && flat(0, 0, 0) && flat(1, 1, -1e-6));
                EXPECT_FALSE(flat(1, 1, 1) || flat(1, 1, -1) || flat(1, 1, 1e-3) || flat(1, -1e-3, 1) || flat(1, 1e-3, 1e-3));
            }
        }
    }
    // A scale that undoes what a mesh is large in leaves it its thickness, and a mesh without thickness doesn't make its matrix flat.
    EXPECT_FALSE(flattens(scaling(1, 1, 1e-6), {1, 1, 1e6}));
    EXPECT_FALSE(flattens(glm::dmat3(1), {1, 1, 0}));
    EXPECT_FALSE(flattens(turned, {1, 1, 1e-9}));
    EXPECT_TRUE(flattens(scaling(1, 1, 0), {1, 1, 0}));
}

TEST(Flattening, IsLeftALittleThickness) {
    for (const glm::dmat3& outer : {glm::dmat3(1), turned}) {
        for (const glm::dmat3& inner : {glm::dmat3(1), turned}) {
            const glm::dmat3 m = outer * scaling(2, 1, 0) * inner, thick = thickened(m, glm::dvec3(1));
            EXPECT_GT(glm::determinant(thick), 0);
            // Along the plane nothing changed, to a part of the thickness; across it the thickness is that share of the size.
            for (int axis = 0; axis < 3; ++axis) EXPECT_LT(glm::distance(thick[axis], m[axis]), 2.1 * leastThickness);
            const double size = std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
            EXPECT_NEAR(glm::dot(outer * glm::dvec3(0, 0, 1), thick * (glm::transpose(inner) * glm::dvec3(0, 0, 1))), leastThickness * size,
                        1e-9);
        }
    }
    EXPECT_LT(glm::determinant(thickened(scaling(1, 1, -1e-5), glm::dvec3(1))), 0) << "what is mirrored stays so";
    EXPECT_EQ(thickened(scaling(1, 0, 0), glm::dvec3(1)), glm::dmat3(0));
    EXPECT_EQ(thickened(scaling(1, 2, 3), glm::dvec3(1)), scaling(1, 2, 3));
    EXPECT_EQ(shapeOf(glm::mat4(0), glm::dvec3(1)), glm::mat3(0));
}

// Faces that looked out of the cube still do, and its ends are where they belong.
TEST(Flattening, FlatCubesFaceBothWays) {
    const glm::quat quarter = glm::angleAxis(0.6f, glm::normalize(glm::vec3(1, 2, 3)));
    for (const bool inner : {false, true}) {
        std::vector<Node> nodes{{.translation = {3, 4, 5}, .rotation = quarter, .scale = {2, 2, 0}}};
        if (inner) nodes.push_back({.rotation = glm::angleAxis(0.5f, glm::normalize(glm::vec3(1, 1, 0)))});
        Scene scene = cubeUnder(nodes);
        shapeFlatInstances(scene);
        ASSERT_EQ(scene.meshes[0].shaper, scene.instances[0].node);
        const Pose pose = poseAt(scene, 0);
        const PosedVertices posed = deform(scene, 0, 0, pose);
        const glm::mat4 matrix = scene.instanceMatrix(scene.instances[0], pose.nodes);
        const glm::vec3 up = quarter * glm::vec3(0, 0, 1);
        const MeshLevel& level = scene.meshes[0].levels[0];
        double above = 0, below = 0;
        for (const glm::uvec3& t : level.triangles) {
            const auto at = [&](std::uint32_t v) { return glm::dvec3(matrix * glm::vec4(posed.positions[v], 1)); };
            const glm::dvec3 area = 0.5 * glm::cross(at(t.y) - at(t.x), at(t.z) - at(t.x));
            const glm::dvec3 middle = 0.5 * (at(t.x) + at(t.x + 2)) - glm::dvec3(3, 4, 5);  // of the face
            const double facing = glm::dot(area, glm::dvec3(up)), height = glm::dot(middle, glm::dvec3(up));
            EXPECT_LT(std::abs(height), 4 * leastThickness);
            if (std::abs(facing) > 0.01) {
                EXPECT_GT(facing * height, 0) << "looks inwards";
            }
            (facing > 0 ? above : below) += std::abs(facing);
            EXPECT_GT(glm::dot(area, glm::dvec3(posed.normals[t.x])), 0) << "its normal has another side";
        }
        EXPECT_NEAR(above, below, 1e-5);
        if (!inner) {
            EXPECT_NEAR(above, 4, 1e-3);
        }
    }
}

TEST(Flattening, OnlyFlatInstancesChange) {
    const auto shaped = [](std::vector<Node> nodes, std::vector<AnimationChannel> animation = {}) {
        Scene scene = cubeUnder(std::move(nodes));
        scene.animation = std::move(animation);
        shapeFlatInstances(scene);
        return scene.meshes[0].shaper != none;
    };
    const auto scaled = [](std::vector<glm::vec4> values, Interpolation how = Interpolation::linear) {
        AnimationChannel channel{.node = 0, .value = AnimatedValue::scale, .interpolation = how};
        for (std::size_t i = 0; i < values.size(); ++i) channel.times.push_back(float(i));
        channel.values = std::move(values);
        return std::vector<AnimationChannel>{channel};
    };
    EXPECT_FALSE(shaped({{}}));
    EXPECT_FALSE(shaped({{.scale = {1, 2, -3}}}));
    EXPECT_FALSE(shaped({{.scale = {0, 0, 0}}})) << "hidden, without a mesh of its own";
    EXPECT_TRUE(shaped({{.scale = {0, 2, 3}}}));
    EXPECT_TRUE(shaped({{.scale = {0, 2, 3}}, {.translation = {1, 2, 3}}}));
    EXPECT_TRUE(shaped({{.matrix = glm::mat4(glm::mat3(scaling(1, 1, 0)))}}));
    EXPECT_TRUE(shaped({{.scale = {1, 1, 1e-3f}}, {.rotation = glm::quat(0.8f, 0.6f, 0, 0), .scale = {1, 1e-3f, 1}}}))
        << "by all of them together";
    EXPECT_FALSE(shaped({{}}, scaled({{1, 1, 1, 0}, {0, 0, 0, 0}, {1, 2, 1, 0}}))) << "shrinks and grows as a whole";
    EXPECT_FALSE(shaped({{}}, scaled({{1, 1, 1, 0}, {-1, -1, -1, 0}})));
    EXPECT_TRUE(shaped({{}}, scaled({{1, 1, 1, 0}, {1, 0, 1, 0}})));
    EXPECT_TRUE(shaped({{}}, scaled({{1, 1, 1, 0}, {-1, 1, 1, 0}}))) << "a card that turns over";
    EXPECT_FALSE(shaped({{}}, scaled({{1, 1, 1, 0}, {-1, 1, 1, 0}}, Interpolation::step)));
    EXPECT_TRUE(shaped({{}, {}}, scaled({{1, 1, 1, 0}, {-1, 1, 1, 0}})));

    Scene two = cubeUnder({{}, {.scale = {1, 1, 0}}});
    two.instances.push_back({"other", 0, 0});
    shapeFlatInstances(two);
    ASSERT_EQ(two.meshes.size(), 2u) << "they shared a mesh";
    EXPECT_EQ(two.meshes[two.instances[0].mesh].shaper, 1u);
    EXPECT_EQ(two.meshes[two.instances[1].mesh].shaper, none);
    EXPECT_EQ(two.instanceMatrix(two.instances[1], two.nodeMatrices(0)), glm::mat4(1));
}

TEST(Axes, OfMatricesThatLackSome) {
    for (const glm::vec3 scale : {glm::vec3(1), glm::vec3(1, 1, 0), glm::vec3(0, 2, 3), glm::vec3(0, 0, 4), glm::vec3(0, 5, 0),
                                  glm::vec3(0), glm::vec3(1e-30f), glm::vec3(1e30f)}) {
        const glm::mat4 m = glm::mat4(glm::mat3(turned)) * glm::scale(glm::mat4(1), scale);
        const glm::mat3 axes = unitAxes(m);
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(glm::length(axes[i]), 1, 1e-6);
            if (scale[i] > 0) {
                EXPECT_LT(glm::distance(axes[i], glm::vec3(turned[i])), 1e-6f);
            }
            const int zeros = int(scale.x == 0) + int(scale.y == 0) + int(scale.z == 0);
            if (zeros < 2) {
                EXPECT_LT(glm::distance(axes[i], glm::vec3(turned[i])), 1e-6f);
            }
        }
    }
}

TEST(Axes, OfViewsWithoutDirection) {
    for (const CameraKey& key :
         {CameraKey{.position = {1, 2, 3}, .target = {1, 2, 3}}, CameraKey{.position = {0, 0, 0}, .target = {0, 0, -1}, .up = {0, 0, 1}},
          CameraKey{.position = {0, 9, 0}, .target = {0, 0, 0}}, CameraKey{.up = {0, 0, 0}}, CameraKey{.up = {0, 1e-20f, 0}},
          CameraKey{.position = {1e20f, 0, 1e20f}, .target = {0, 0, 0}}}) {
        const ViewAxes axes = viewAxes(key);
        const glm::mat3 all(axes.right, axes.up, -axes.forward);
        EXPECT_NEAR(glm::determinant(all), 1, 1e-5);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(glm::length(all[i]), 1, 1e-5);
    }
    EXPECT_EQ(viewAxes({.up = {0, 1e-20f, 0}}).up, glm::vec3(0, 1, 0)) << "however short `up` is";
}
