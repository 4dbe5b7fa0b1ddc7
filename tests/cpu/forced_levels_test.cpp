// SPDX-License-Identifier: MIT
// Levels forced by name: if this fails, a switch made by hand meets another instance than the one that was meant.
#include <framework/core/error.h>
#include <framework/scene/forced_levels.h>

#include <gtest/gtest.h>

namespace lodestir {
namespace {

/// Three instances of a mesh of three levels, two of one name, below the node "left"; one of a mesh that has a single level.
Scene makeScene() {
    Scene scene;
    scene.meshes.resize(2);
    scene.meshes[0].levels.resize(3);
    scene.meshes[1].levels.resize(1);
    scene.nodes = {{.name = "left"}, {.name = "rock"}, {.name = "tree", .parent = 0}, {.name = "tree", .parent = 0}, {.name = "plain, wide"}};
    scene.instances = {{"rock", 0, 1}, {"tree", 0, 2}, {"tree", 0, 3}, {"plain, wide", 1, 4}};
    return scene;
}

using Levels = std::vector<std::uint32_t>;

TEST(ForcedLevels, WhoIsMeant) {
    const Scene scene = makeScene();
    EXPECT_EQ(forcedLevels(scene, ""), (Levels{none, none, none, none}));
    EXPECT_EQ(forcedLevels(scene, "rock=2"), (Levels{2, none, none, none}));
    EXPECT_EQ(forcedLevels(scene, "tree=1"), (Levels{none, 1, 1, none}));
    EXPECT_EQ(forcedLevels(scene, "left=1"), (Levels{none, 1, 1, none}));  // no instance, but a node
    EXPECT_EQ(forcedLevels(scene, "#2=0"), (Levels{none, none, 0, none}));
    EXPECT_EQ(forcedLevels(scene, "*=7"), (Levels{2, 2, 2, 0}));  // at most the coarsest
    EXPECT_EQ(forcedLevels(scene, " * = 1 ,tree = auto, #1=2"), (Levels{1, 2, none, 0}));
}

TEST(ForcedLevels, IsReadAsItIsWritten) {
    const std::vector<ForcedLevel> forced{{"*", 1}, {"a=b", 2}, {"#3", std::nullopt}};
    EXPECT_EQ(writeForced(forced), "*=1, a=b=2, #3=auto");
    EXPECT_EQ(readForced(writeForced(forced)), forced);
    EXPECT_TRUE(readForced("  ").empty());
}

TEST(ForcedLevels, WhoIsSaidSoThatItIsReadBack) {
    const Scene scene = makeScene();
    EXPECT_EQ(whoIs(scene, 0), "rock");
    Scene placed = scene;
    placed.nodes[3].parent = 1;  // one tree on the left, one on the rock
    EXPECT_EQ(whoIs(placed, 1), "left");
    EXPECT_EQ(whoIs(placed, 2), "#2");  // "rock" is the rock
    EXPECT_EQ(whoIs(scene, 2), "#2");  // one of two trees
    EXPECT_EQ(whoIs(scene, 3), "#3");  // its name has a comma
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        Levels expected(scene.instances.size(), none);
        expected[i] = 0;
        EXPECT_EQ(forcedLevels(scene, writeForced({{whoIs(scene, i), 0}})), expected);
    }
}

TEST(ForcedLevels, Mistakes) {
    const Scene scene = makeScene();
    const auto complaint = [&](const std::string& text) -> std::string {
        try {
            forcedLevels(scene, text);
        } catch (const Error& error) {
            return error.problems().at(0).what + "; " + error.problems()[0].hint;
        }
        return "none";
    };
    for (const char* text : {"rock", "rock=", "=1", "rock=8", "rock=-1", "rock=1,", "rock=one"})
        EXPECT_NE(complaint(text).find("forces no level; write it like rock=2"), std::string::npos) << text;
    EXPECT_EQ(complaint("rok=1"), "there is no instance \"rok\" to force a level on; did you mean \"rock\"?");
    EXPECT_NE(complaint("#4=1").find("no instance \"#4\""), std::string::npos);
}

}  // namespace
}  // namespace lodestir
