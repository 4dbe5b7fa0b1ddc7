// SPDX-License-Identifier: MIT
// Generated scenes hold what they are judged by: glass is closed, lamps are as many as is said and move where that is the point. Pictures look right without.
#include "source_folder.h"

#include <framework/core/files.h>
#include <framework/scene/level_policy.h>
#include <framework/scene/scene.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace lodestir::test {
namespace {

/// A tenth of a millimetre: vertices of one place that were computed along different roads.
using Place = std::array<long, 3>;
Place placeOf(const glm::vec3& p) { return {std::lround(p.x * 1e4f), std::lround(p.y * 1e4f), std::lround(p.z * 1e4f)}; }

/// Bodies of a level that glow as lamps do: sets of triangles that hang together. For each, one of its points.
std::vector<glm::vec3> lampsOf(const Scene& scene, const MeshLevel& level) {
    std::map<Place, std::size_t> ids;
    std::vector<std::size_t> parents;
    std::vector<glm::vec3> points;
    const auto root = [&](std::size_t i) {
        while (parents[i] != i) i = parents[i] = parents[parents[i]];
        return i;
    };
    for (std::size_t t = 0; t < level.triangles.size(); ++t) {
        if (!scene.materials[level.materials[t]].isLight()) continue;
        std::array<std::size_t, 3> corners{};
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 p = level.positions[level.triangles[t][k]];
            const auto [entry, fresh] = ids.try_emplace(placeOf(p), parents.size());
            if (fresh) parents.push_back(parents.size()), points.push_back(p);
            corners[std::size_t(k)] = entry->second;
        }
        parents[root(corners[1])] = root(corners[0]);
        parents[root(corners[2])] = root(corners[0]);
    }
    std::vector<glm::vec3> lamps;
    for (std::size_t i = 0; i < parents.size(); ++i)
        if (root(i) == i) lamps.push_back(points[i]);
    return lamps;
}

/// How many lamps a scene has, and how many of them have gone elsewhere by a later frame.
struct Lamps {
    int all = 0, moved = 0;
};

Lamps lampsOf(const Scene& scene, float frame) {
    std::vector<std::vector<glm::vec3>> ofMesh;
    for (const Mesh& mesh : scene.meshes) ofMesh.push_back(lampsOf(scene, mesh.levels.front()));
    const auto before = scene.nodeMatrices(0), after = scene.nodeMatrices(frame);
    Lamps lamps;
    for (const Instance& instance : scene.instances)
        for (const glm::vec3& lamp : ofMesh[instance.mesh]) {
            const auto at = [&](const auto& nodes) { return glm::vec3(scene.instanceMatrix(instance, nodes) * glm::vec4(lamp, 1)); };
            ++lamps.all;
            if (glm::distance(at(before), at(after)) > 0.1f) ++lamps.moved;
        }
    return lamps;
}

Scene loaded(const std::string& name) { return loadScene(sourceFolder / "scenes" / (name + ".json")); }

// A path that finds a hole in a solid goes on in the wrong medium. Every edge of a closed surface is walked both ways equally often.
TEST(GeneratedScenes, SolidGlassIsClosed) {
    std::set<std::string> models;
    for (const auto& entry : std::filesystem::directory_iterator(sourceFolder / "scenes")) {
        if (entry.path().extension() != ".json" || entry.path().stem() == "statue") continue;  // which is made on demand, and has no glass
        if (!models.insert(nlohmann::json::parse(readText(entry.path()))["models"].dump()).second) continue;  // another view of them
        const Scene scene = loadScene(entry.path());
        for (const Mesh& mesh : scene.meshes) {
            const MeshLevel& level = mesh.levels.front();
            std::map<std::pair<Place, Place>, int> edges;
            for (std::size_t t = 0; t < level.triangles.size(); ++t) {
                if (!scene.materials[level.materials[t]].solid) continue;
                for (int k = 0; k < 3; ++k) {
                    const Place from = placeOf(level.positions[level.triangles[t][k]]), to = placeOf(level.positions[level.triangles[t][(k + 1) % 3]]);
                    if (from < to) ++edges[{from, to}];
                    if (to < from) --edges[{to, from}];
                }
            }
            const auto open = std::ranges::count_if(edges, [](const auto& edge) { return edge.second != 0; });
            EXPECT_EQ(open, 0) << entry.path().filename() << ": mesh '" << mesh.name << "' has open edges in its solid glass";
        }
    }
}

TEST(GeneratedScenes, LampsOfTheCarouselMove) {
    const Lamps lamps = lampsOf(loaded("carousel"), 12);
    EXPECT_GE(lamps.moved, 560);
    EXPECT_LT(lamps.moved, lamps.all);  // street lamps stand
}

TEST(GeneratedScenes, HaveAsManyLampsAsTheySay) {
    EXPECT_GE(lampsOf(loaded("opera_hall"), 0).all, 400);
    EXPECT_GE(lampsOf(loaded("bridge"), 0).all, 1000);
}

// Whatever is found there came from outside: the window is the only lamp of the hall.
TEST(GeneratedScenes, TheHallHasNoLampOfItsOwn) {
    const Scene scene = loaded("far_window");
    EXPECT_EQ(lampsOf(scene, 0).all, 0);
    EXPECT_TRUE(scene.lights.empty());
}

// What levels are dissolved on: each has half the triangles of the one before, and none lost a limb or a chart of its picture.
TEST(GeneratedScenes, TheCreaturesAreOfEightLevels) {
    const Scene scene = loaded("creatures_close");
    const auto creature = std::ranges::find(scene.meshes, "creature", &Mesh::name);
    ASSERT_NE(creature, scene.meshes.end());
    ASSERT_EQ(creature->levels.size(), 8u);
    EXPECT_GT(creature->levels.front().triangles.size(), 200'000u);
    for (std::size_t l = 1; l < 8; ++l) {
        const MeshLevel &finer = creature->levels[l - 1], &coarser = creature->levels[l];
        EXPECT_NEAR(double(finer.triangles.size()) / double(coarser.triangles.size()), 2, 0.01) << "level " << l;
        EXPECT_GT(coarser.error, finer.error) << "level " << l;
    }
    EXPECT_LT(creature->levels.back().error, 0.05f);
    const auto index = std::uint32_t(creature - scene.meshes.begin());
    EXPECT_EQ(std::ranges::count(scene.instances, index, &Instance::mesh), 64 * 60);
}

// Studies of level switches measure around frame 40, where nothing else may happen but that the camera goes on: no light may switch.
TEST(GeneratedScenes, LevelsSwitchAtFrame40BeforeAMovingCamera) {
    struct Switching {
        const char *scene, *mesh;
        std::size_t levels;
    };
    const Switching switching[] = {{"hallway", "cat", 4},     {"coastal_cliff", "cliff", 3}, {"coastal_cliff", "stack", 3},     {"lantern", "lantern", 4},
                                   {"terrain", "terrain", 3}, {"cloth", "cloth", 4},         {"chess_focus", "white_pawn", 3}};
    for (const auto& [name, meshName, levels] : switching) {
        SCOPED_TRACE(name);
        const Scene scene = loaded(name);
        const auto mesh = std::ranges::find(scene.meshes, meshName, &Mesh::name);
        ASSERT_NE(mesh, scene.meshes.end());
        EXPECT_EQ(mesh->levels.size(), levels);
        const auto before = levelsAt(scene, 39), after = levelsAt(scene, 40);
        EXPECT_EQ(levelsAt(scene, 0), before);
        EXPECT_EQ(levelsAt(scene, 80), after);
        int switched = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (before[i] == after[i]) continue;
            const Mesh& shown = scene.meshes[scene.instances[i].mesh];
            if (&shown == &*mesh) ++switched;
            EXPECT_TRUE(std::ranges::none_of(shown.levels.front().materials, [&](std::uint32_t m) { return scene.materials[m].isLight(); })) << shown.name;
        }
        EXPECT_GT(switched, 0);
        const auto from = scene.cameraAt(39), to = scene.cameraAt(41);
        EXPECT_TRUE(from.position != to.position || from.focus != to.focus);
    }
}

/// Of all that glows in a scene, at the levels of a frame: triangles, and their area in space.
struct Glowing {
    std::size_t triangles = 0;
    double area = 0;
};

std::map<std::string, Glowing> glowingOf(const Scene& scene, float frame) {
    std::map<std::string, Glowing> glowing;
    const std::vector<std::uint32_t> shown = levelsAt(scene, frame);
    const auto nodes = scene.nodeMatrices(frame);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const MeshLevel& level = scene.meshes[instance.mesh].levels[shown[i]];
        const glm::mat3 linear(scene.instanceMatrix(instance, nodes));
        for (std::size_t t = 0; t < level.triangles.size(); ++t) {
            if (!scene.materials[level.materials[t]].isLight()) continue;
            const auto at = [&](int k) { return linear * level.positions[level.triangles[t][k]]; };
            Glowing& g = glowing[instance.name];
            ++g.triangles;
            g.area += 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
        }
    }
    return glowing;
}

// Whether light is found without bias across a switch is judged where there is no other light than what switches, and its area, hence power, changes.
TEST(GeneratedScenes, AllThatGlowsSwitches) {
    const Scene scene = loaded("ensemble_emitter");
    EXPECT_TRUE(scene.lights.empty());
    const auto before = glowingOf(scene, 39), after = glowingOf(scene, 40);
    EXPECT_EQ(before.size(), 3u);
    for (const auto& [name, glowing] : before) {
        const Glowing& other = after.at(name);
        const double triangles = double(glowing.triangles) / double(other.triangles), area = glowing.area / other.area;
        EXPECT_GT(std::max(triangles, 1 / triangles), 8) << name;
        EXPECT_GT(std::max(area, 1 / area), 1.03) << name;
    }
}

// The rabbit is in motion where it switches.
TEST(GeneratedScenes, WhatBendsSwitches) {
    const Scene scene = loaded("ensemble_bending");
    const auto rabbit = std::ranges::find(scene.meshes, "rabbit", &Mesh::name);
    ASSERT_NE(rabbit, scene.meshes.end());
    EXPECT_TRUE(rabbit->deforms());
    EXPECT_EQ(rabbit->levels.size(), 3u);
    EXPECT_NE(levelsAt(scene, 39), levelsAt(scene, 40));
    const auto index = std::size_t(rabbit - scene.meshes.begin());
    EXPECT_GT(std::abs(scene.morphWeights(40)[index][0] - scene.morphWeights(39)[index][0]), 0.05f);
}

// The cobra's levels follow the same joints, and these turn where it switches.
TEST(GeneratedScenes, WhatJointsBendSwitches) {
    const Scene scene = loaded("ensemble_skinned");
    const auto cobra = std::ranges::find(scene.meshes, "cobra", &Mesh::name);
    ASSERT_NE(cobra, scene.meshes.end());
    ASSERT_NE(cobra->skin, none);
    EXPECT_EQ(scene.skins[cobra->skin].nodes.size(), 4u);
    ASSERT_EQ(cobra->levels.size(), 3u);
    for (const MeshLevel& level : cobra->levels) {
        EXPECT_EQ(level.joints.size(), level.positions.size());
        for (std::uint32_t joint = 0; joint < 4; ++joint)
            EXPECT_TRUE(std::ranges::any_of(level.joints, [&](const VertexJoints& v) { return v.joints[0] == joint || v.joints[1] == joint; })) << joint;
    }
    EXPECT_NE(levelsAt(scene, 39), levelsAt(scene, 40));
}

// Convergence under motion is judged without gloss, which would move of its own.
TEST(GeneratedScenes, TheWatercolourIsMattAndItsCameraRises) {
    const Scene scene = loaded("watercolour");
    for (const Material& material : scene.materials) {
        EXPECT_EQ(material.ior, 1) << material.name;
        EXPECT_EQ(material.metallic, 0) << material.name;
    }
    for (float frame = 1; frame <= 60; ++frame) EXPECT_GT(scene.cameraAt(frame).position.y, scene.cameraAt(frame - 1).position.y);
}

}  // namespace
}  // namespace lodestir::test
