// SPDX-License-Identifier: MIT
// What a click meets: if this fails, another thing is edited than the one pointed at.
#include <framework/app/view/picking.h>

#include <gtest/gtest.h>

namespace lodestir {
namespace {

/// A square of the half size 1 across the z axis, and at level 1 one of half that size.
Mesh makeSquare(std::uint32_t material) {
    Mesh mesh;
    for (const float half : {1.0f, 0.5f}) {
        MeshLevel level;
        level.positions = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
        level.triangles = {{0, 1, 2}, {0, 2, 3}};
        level.materials = {material, material};
        mesh.levels.push_back(level);
    }
    return mesh;
}

/// Two squares behind each other, at z = 0 and z = -2, the farther one three times as large.
Scene makeScene() {
    Scene scene;
    scene.materials.resize(2);
    scene.meshes = {makeSquare(0), makeSquare(1)};
    scene.nodes = {{.name = "near"}, {.name = "far", .translation = {0, 0, -2}, .scale = glm::vec3(3)}};
    scene.instances = {{"near", 0, 0}, {"far", 1, 1}};
    return scene;
}

const CameraKey camera{.position = {0, 0, 5}, .target = {0, 0, 0}, .fovy = 0.8f};

std::optional<Picked> pickAt(const Scene& scene, glm::vec2 place, std::vector<std::uint32_t> levels = {0, 0}, const CameraKey& from = camera) {
    return pick(scene, poseAt(scene, 0), levels, viewRay(from, place, 1.5f));
}

TEST(Picking, TheNearestIsMet) {
    const Scene scene = makeScene();
    const auto middle = pickAt(scene, {0.5f, 0.5f});
    ASSERT_TRUE(middle);
    EXPECT_EQ(middle->instance, 0u);
    EXPECT_EQ(middle->material, 0u);
    EXPECT_NEAR(middle->point.z, 0, 1e-6f);
    const auto beside = pickAt(scene, {0.8f, 0.5f});
    ASSERT_TRUE(beside);
    EXPECT_EQ(beside->instance, 1u);
    EXPECT_NEAR(beside->point.z, -2, 1e-5f);
    EXPECT_FALSE(pickAt(scene, {0.01f, 0.01f}));
}

TEST(Picking, TheLevelThatIsShownIsMet) {
    const Scene scene = makeScene();
    const glm::vec2 place = *placeOf(camera, {0.7f, 0.1f, 0}, 1.5f);
    EXPECT_EQ(pickAt(scene, place)->instance, 0u);
    EXPECT_EQ(pickAt(scene, place, {1, 0})->instance, 1u);
}

// There and back: the ray through the place of a point meets the point, whatever the camera.
TEST(Picking, PlacesAreWhereRaysGo) {
    const Scene scene = makeScene();
    for (const float height : {0.0f, 4.0f}) {
        CameraKey from = orbited(camera, 0.4f, 0.3f);
        from.height = height;
        const glm::vec3 point(0.6f, -0.4f, 0);
        const auto place = placeOf(from, point, 1.5f);
        ASSERT_TRUE(place);
        const auto picked = pickAt(scene, *place, {0, 0}, from);
        ASSERT_TRUE(picked);
        for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(picked->point[axis], point[axis], 1e-5f);
    }
    EXPECT_FALSE(placeOf(camera, {0, 0, 6}, 1.5f));  // behind it
}

TEST(Picking, MeshesThatMoveAreMetWhereTheyAre) {
    Scene scene = makeScene();
    scene.animation = {{.node = 0, .value = AnimatedValue::translation, .times = {0, 1}, .values = {{0, 0, 0, 0}, {30, 0, 0, 0}}}};
    scene.animationLength = 1;
    EXPECT_EQ(pick(scene, poseAt(scene, 15), std::vector<std::uint32_t>{0, 0}, viewRay(camera, {0.5f, 0.5f}, 1.5f))->instance, 1u);
}

}  // namespace
}  // namespace lodestir
