// SPDX-License-Identifier: MIT
// Paths found in what shaders told of a pixel, and where a camera has their vertices.
#include <framework/app/view/orbit_camera.h>
#include <framework/app/view/told_paths.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lodestir {
namespace {

const char* const told = R"({
  "initial": { "type": "initial_sampling", "ports": { "depth": 3.0 }, "dispatches": [ { "shader": "a.comp", "invocations": [ { "pixel": [4, 5], "trees": [
    { "vertices": [ { "vertex": 1, "position": [1, 2, 3] }, { "vertex": 2, "position": [4, 5, 6] }, { "vertex": 3, "met": "environment" } ] },
    { "vertices": [ { "vertex": 1, "met": "environment" } ] } ] } ] } ] },
  "spatial": { "dispatches": [ { "invocations": [ { "shifts": [
    { "way": "forth", "from": [7, 8], "to": [4, 5], "jacobian": 1.25, "candidate": { "m": 0.5, "taken": true }, "vertices": [ { "position": [0, 0, 0] } ] },
    { "way": "back", "from": [4, 5], "to": [7, 8], "jacobian": 0.0, "vertices":
      [ { "position": [0, 0, 1] }, { "failed": "something is in the way" } ] } ] } ] } ] } })";

TEST(ToldPaths, AreFoundWhereverTheyStand) {
    const std::vector<ToldPath> paths = pathsIn(nlohmann::ordered_json::parse(told));
    ASSERT_EQ(paths.size(), 3u) << "a path without a vertex in the scene is none to draw";
    EXPECT_EQ(paths[0].pass, "initial");
    EXPECT_EQ(paths[0].name, "tree");
    EXPECT_EQ(paths[0].vertices, (std::vector<glm::vec3>{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_FALSE(paths[0].failed);
    EXPECT_EQ(paths[1].name, "shift forth (7, 8) -> (4, 5)");
    EXPECT_EQ(paths[1].text, "J 1.25, m 0.5, taken");
    EXPECT_FALSE(paths[1].failed);
    EXPECT_EQ(paths[2].text, "something is in the way");
    EXPECT_TRUE(paths[2].failed);
    EXPECT_TRUE(pathsIn(nlohmann::ordered_json::object()).empty());
}

// If this fails, a path is drawn beside the pixel that it belongs to.
TEST(PlaceInPicture, IsWhereACameraHasAPoint) {
    CameraKey camera{.position = {0, 0, 5}, .target = {0, 0, 0}, .fovy = glm::radians(90.0f)};
    const auto place = [&](const glm::vec3& point) {
        const glm::vec3 p = placeInPicture(camera, point, 2);
        return glm::vec2(p) / p.z;
    };
    const auto near = [](glm::vec2 a, glm::vec2 b) { return glm::length(a - b) < 1e-5f; };
    // At the target's distance the picture is 10 high and 20 wide.
    EXPECT_TRUE(near(place({0, 0, 0}), {0.5f, 0.5f}));
    EXPECT_TRUE(near(place({10, 0, 0}), {1, 0.5f}));
    EXPECT_TRUE(near(place({0, 5, 0}), {0.5f, 0}));
    EXPECT_TRUE(near(place({5, -5, -5}), {0.5f + 0.125f, 0.75f}));
    EXPECT_LT(placeInPicture(camera, {0, 0, 6}, 2).z, 0);
    camera.height = 4;
    EXPECT_TRUE(near(place({4, 2, -100}), {1, 0}));
}

}  // namespace
}  // namespace lodestir
