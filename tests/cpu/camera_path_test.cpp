// SPDX-License-Identifier: MIT
// Cameras written and read: if this fails, a run doesn't see what was seen when a path was made.
#include <framework/app/view/camera_path.h>
#include <framework/core/error.h>

#include "../temporary_folder.h"
#include "gltf_model.h"

#include <gtest/gtest.h>

namespace lodestir {
namespace {

using test::TemporaryFolder;

/// Nothing of it is a short decimal.
CameraKey crooked(float frame) {
    CameraKey key{
        .frame = frame, .position = {0.1f + frame, 1 / 3.0f, 5}, .target = {0, 0.7071068f, -1e-7f}, .fovy = 0.7853f, .aperture = 0.012f, .focus = 4.9f};
    return orbited(key, 0.3f, 0.17f);
}

TEST(CameraPath, KeysStayInTheOrderOfFrames) {
    std::vector<CameraKey> keys;
    for (const float frame : {30.0f, 0.0f, 60.0f, 30.0f}) keys = withKey(keys, crooked(frame));
    ASSERT_EQ(keys.size(), 3u);
    for (std::size_t i = 0; i < keys.size(); ++i) EXPECT_EQ(keys[i].frame, 30 * float(i));
}

TEST(CameraPath, ViewsAreReadAsTheyWere) {
    const std::vector<SavedView> views{{"door", crooked(0)}, {"window", crooked(7)}};
    const std::vector<SavedView> read = readViews(Json::parse(viewsJson(views).dump(), "views"));
    ASSERT_EQ(read.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        CameraKey expected = views[i].camera;
        expected.frame = 0;
        EXPECT_EQ(read[i].name, views[i].name);
        EXPECT_EQ(read[i].camera, expected);
    }
    EXPECT_THROW(readViews(Json::parse(R"({"format": 1, "views": [{"name": "x"}]})", "views")), Error);
}

TEST(CameraPath, SceneIsTheSameWithAnotherCamera) {
    const TemporaryFolder folder;
    const std::vector<CameraKey> keys{crooked(0), crooked(12.5f), crooked(40)};
    GltfModel one;
    one.addTriangle();
    const Path model = one.write(folder.path / "models/one.gltf");
    writeFile(folder.path / "scene.json",
              R"({"format": 1, "models": {"m": {"file": "models/one.gltf"}}, "exposure": 2, "cut": [3],
                  "camera": {"position": [0, 0, 9], "target": [0, 0, 0]}})");
    for (const Path& scene : {folder.path / "scene.json", model}) {
        const Path made = folder.path / "out/deep/made.json";
        writeFile(made, sceneWithPath(scene, keys, made.parent_path()).dump());
        const Scene read = loadScene(made), original = loadScene(scene);
        EXPECT_EQ(read.camera.keys, keys) << scene;
        EXPECT_EQ(read.camera.node, none);
        EXPECT_EQ(read.exposure, original.exposure);
        EXPECT_EQ(read.cuts, original.cuts);
        EXPECT_EQ(read.environment.radiance.size(), original.environment.radiance.size());
        EXPECT_EQ(read.meshes.size(), original.meshes.size());
    }
}

}  // namespace
}  // namespace lodestir
