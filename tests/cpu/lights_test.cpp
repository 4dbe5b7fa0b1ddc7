// SPDX-License-Identifier: MIT
// The tables that lights are sampled by.
#include <framework/scene/upload/alias_table.h>
#include <framework/scene/upload/cumulative_table.h>
#include <framework/scene/upload/environment_table.h>
#include <framework/scene/upload/light_list.h>
#include <framework/scene/upload/mipmaps.h>

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace lodestir;

namespace {

/// Probability of each entry when the table is walked: the uniform choice keeps its own share and hands the rest to its alias.
std::vector<double> walked(const std::vector<AliasEntry>& table) {
    std::vector<double> probability(table.size(), 0.0);
    for (std::size_t i = 0; i < table.size(); ++i) {
        probability[i] += table[i].aliasProbability / double(table.size());
        probability[table[i].alias] += (1 - table[i].aliasProbability) / double(table.size());
    }
    return probability;
}

/// One emissive unit square (two triangles) seen by `materials[0]`, at the identity.
Scene squareScene(float emission) {
    Scene scene;
    scene.materials.push_back({.name = "light", .emission = glm::vec3(emission)});
    MeshLevel level;
    level.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    level.normals.assign(4, {0, 0, 1});
    level.triangles = {{0, 1, 2}, {0, 2, 3}};
    level.materials = {0, 0};
    scene.meshes.push_back({"square", {level}});
    scene.nodes.push_back({.name = "root"});
    scene.instances.push_back({"square", 0, 0});
    return scene;
}

LevelEmitters squareEmitters() { return {.primitives = {0, 1}, .triangles = {{0, 1, 2}, {0, 2, 3}}, .materials = {0, 0}}; }

}  // namespace

// If this failed, some lights would be chosen more or less often than the density that the estimators divide by.
TEST(AliasTable, GivesEachEntryItsShare) {
    const std::vector<double> weights{5, 0, 1, 0.25, 8, 0, 0.001, 3};
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const auto table = makeAliasTable(weights);
    const auto probability = walked(table);
    for (std::size_t i = 0; i < weights.size(); ++i) {
        EXPECT_NEAR(probability[i], weights[i] / total, 1e-6) << i;
        EXPECT_NEAR(table[i].pmf, weights[i] / total, 1e-6) << i;
        if (weights[i] == 0) {
            EXPECT_EQ(probability[i], 0.0) << "entry " << i << " without weight is chosen";
        }
    }
}

TEST(AliasTable, EqualAndAbsentWeights) {
    for (const std::vector<double>& weights : {std::vector<double>(7, 1.0), std::vector<double>(7, 0.0)})
        for (double p : walked(makeAliasTable(weights))) EXPECT_NEAR(p, 1.0 / 7, 1e-7);
    EXPECT_TRUE(makeAliasTable({}).empty());
}

/// What a number chooses, as light/light.glsl looks it up.
std::uint32_t numbered(const std::vector<CumulativeEntry>& table, std::uint32_t number) {
    const std::size_t part = std::size_t(std::uint64_t(number) * table.size() >> 32);
    std::uint32_t entry = table[part].start, end = part + 1 < table.size() ? table[part + 1].start : std::uint32_t(table.size() - 1);
    while (entry < end) {
        const std::uint32_t middle = (entry + end) / 2;
        if (number > table[middle].last) entry = middle + 1;
        else end = middle;
    }
    return entry;
}

// Each entry has as many numbers as its density says, and none without weight, however small or many.
TEST(CumulativeTable, GivesEachEntryItsNumbers) {
    std::vector<double> steep(300);
    for (std::size_t i = 0; i < steep.size(); ++i) steep[i] = i % 7 == 3 ? 0 : std::pow(1.4, double(i % 150));
    for (const std::vector<double>& weights :
         {std::vector<double>{5, 0, 1, 0.25, 8, 0, 0.001, 3}, std::vector<double>{0, 0, 2, 1e-30, 0}, std::vector<double>{7},
          std::vector<double>(1000, 1.0), std::vector<double>(5, 0.0), steep}) {
        const auto table = makeCumulativeTable(weights);
        const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
        std::uint64_t next = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            const double share = total > 0 ? weights[i] / total : 1.0 / double(weights.size());
            EXPECT_NEAR(table[i].pmf, share, 1e-7 + 1e-9 * double(weights.size())) << i;
            ASSERT_EQ(table[i].pmf > 0, share > 0) << i;
            if (share == 0) continue;
            const std::uint32_t first = std::uint32_t(next), last = table[i].last;
            EXPECT_EQ(float((double(last) - double(first) + 1) / 4294967296.0), table[i].pmf) << i;
            EXPECT_EQ(numbered(table, first), i);
            EXPECT_EQ(numbered(table, first + (last - first) / 2), i);
            EXPECT_EQ(numbered(table, last), i);
            next = std::uint64_t(last) + 1;
        }
        EXPECT_EQ(next, 1ull << 32);
    }
    EXPECT_TRUE(makeCumulativeTable({}).empty());
}

// Areas of triangles that turn differ by rounding from frame to frame, and lights that flicker by more: a path's number has to choose the same light
// nearly always, or what history knows of it is worth nothing.
TEST(CumulativeTable, NumbersKeepTheirEntryWhereWeightsHardlyChange) {
    std::vector<double> weights(5000);
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = 1 + 0.5 * std::sin(double(i));
    std::vector<double> rounded = weights;
    for (std::size_t i = 0; i < weights.size(); ++i) rounded[i] *= 1 + 1e-7 * std::cos(31.0 * double(i));
    const auto before = makeCumulativeTable(weights), after = makeCumulativeTable(rounded);
    int others = 0;
    for (std::uint32_t k = 0; k < 100000; ++k) others += numbered(before, k * 2654435761u) != numbered(after, k * 2654435761u);
    EXPECT_LT(others, 100);
}

/// `emitters`: of each mesh, by level.
LightList lightsOf(const Scene& scene, const std::vector<std::vector<LevelEmitters>>& emitters, float radius) {
    std::vector<glm::vec4> positions;
    const auto positionsOf = [&](std::size_t mesh, std::size_t level) {
        positions.clear();
        for (const glm::vec3& p : scene.meshes[mesh].levels[level].positions) positions.emplace_back(p, 0);
        return std::span<const glm::vec4>(positions);
    };
    return listLights(scene, emitters, positionsOf, std::vector{glm::mat4(1)}, radius);
}

// Power is a half of the choice, the kind of light the other half: here one kind, so the two triangles share evenly.
TEST(LightList, TrianglesByPower) {
    const Scene scene = squareScene(3);
    const LightList list = lightsOf(scene, {{squareEmitters()}}, 1);
    ASSERT_EQ(list.lights.size(), 2u);
    EXPECT_EQ(list.firstLight[0], 0u);
    EXPECT_EQ(list.environmentLight, NONE);
    for (const LightRecord& light : list.lights) {
        EXPECT_EQ(light.type, LIGHT_TRIANGLE);
        EXPECT_NEAR(light.pmf, 0.5f, 1e-6f);
    }
}

// A kind of light that is far weaker than another must keep a fair share, or the corner that it alone lights is all noise.
TEST(LightList, NoKindStarves) {
    Scene scene = squareScene(1e-4f);
    scene.environment.radiance = {glm::vec3(1)};
    scene.lights.push_back({.name = "lamp", .type = LightType::point, .intensity = 1e-5f, .node = 0});
    const LightList list = lightsOf(scene, {{squareEmitters()}}, 10);
    ASSERT_EQ(list.lights.size(), 4u);
    EXPECT_EQ(list.environmentLight, 3u);
    EXPECT_NEAR(list.lights[0].pmf + list.lights[1].pmf, 1.0 / 6, 1e-3);
    EXPECT_NEAR(list.lights[2].pmf, 1.0 / 6, 1e-3);
    EXPECT_NEAR(list.lights[3].pmf, 0.5 + 1.0 / 6, 1e-3);
}

// If this failed, a switch of level would send numbers to another instance, or leave some that choose nothing; or the power of a level's triangles
// wouldn't decide which of them is chosen.
TEST(LightList, CoarserLevelsShareTheNumbersOfTheFinest) {
    Scene scene = squareScene(3);
    MeshLevel coarse = scene.meshes[0].levels[0];
    coarse.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0.9f, 0}, {0, 0.3f, 0}};
    scene.meshes[0].levels.push_back(coarse);
    scene.meshes[0].levels.push_back({.positions = coarse.positions, .normals = coarse.normals, .triangles = {{0, 1, 2}}, .materials = {0}});
    scene.instances.push_back({"another", 0, 0});
    scene.lights.push_back({.name = "lamp", .type = LightType::point, .intensity = 1, .node = 0});
    LevelEmitters single{.primitives = {4}, .triangles = {{0, 1, 2}}, .materials = {0}}, second = squareEmitters();
    second.primitives = {2, 3};
    const LightList list = lightsOf(scene, {{squareEmitters(), second, single}}, 1);
    EXPECT_EQ(list.count, 5u);
    ASSERT_EQ(list.lights.size(), 5u + 2 * 3u);
    std::uint64_t first = 0;  // of the numbers of an instance
    for (std::uint32_t i = 0; i < 2; ++i) {
        EXPECT_EQ(list.firstLight[i], 2 * i);
        const std::uint32_t last = list.lights[2 * i + 1].last, at = list.coarserLights[i];
        ASSERT_LE(at + 3, list.levels.size());
        const std::uint32_t begin = 5 + 3 * i;
        EXPECT_EQ(list.levels[at], begin);
        EXPECT_EQ(list.levels[at + 1], begin + 2);
        EXPECT_EQ(list.levels[at + 2], begin + 3);
        const float all = list.lights[2 * i].pmf + list.lights[2 * i + 1].pmf;
        EXPECT_NEAR(list.lights[begin].pmf, 0.75f * all, 1e-6f);
        EXPECT_NEAR(list.lights[begin + 1].pmf, 0.25f * all, 1e-6f);
        EXPECT_NEAR(list.lights[begin + 2].pmf, all, 1e-6f);
        EXPECT_EQ(list.lights[begin + 1].last, last);
        EXPECT_EQ(list.lights[begin + 2].last, last);
        EXPECT_NEAR(double(list.lights[begin].last + 1.0 - double(first)) / 4294967296.0, list.lights[begin].pmf, 1e-7);
        for (std::uint32_t k = begin; k < begin + 3; ++k) EXPECT_EQ(list.lights[k].instance, i);
        EXPECT_EQ(list.lights[begin + 2].primitive, 4u);
        first = std::uint64_t(last) + 1;
    }
}

TEST(LightList, BlackThingsAreNoLights) {
    Scene scene = squareScene(0);
    const LightList list = lightsOf(scene, {{LevelEmitters{}}}, 1);
    EXPECT_TRUE(list.lights.empty());
    EXPECT_EQ(list.firstLight[0], NONE);
}

// The density over the unit square of uv must integrate to 1, and follow the light: a constant sky is sampled by solid angle.
TEST(EnvironmentTable, DensityIntegratesToOneAndFollowsSolidAngle) {
    Environment map;
    map.width = 16;
    map.height = 8;
    map.radiance.assign(128, glm::vec3(2));
    const auto texels = environmentTable(map);
    double integral = 0;
    for (const EnvironmentTexel& t : texels) integral += t.density / 128;
    EXPECT_NEAR(integral, 1, 1e-5);
    const double ratio = texels[0].density / texels[3 * 16].density;
    EXPECT_NEAR(ratio, std::sin(glm::pi<double>() * 0.5 / 8) / std::sin(glm::pi<double>() * 3.5 / 8), 1e-5);
}

// Radiance is interpolated when it is read, so wherever it is positive the density must be.
TEST(EnvironmentTable, NeighboursOfABrightTexelCanBeChosen) {
    Environment map;
    map.width = 16;
    map.height = 8;
    map.radiance.assign(128, glm::vec3(0));
    map.radiance[4 * 16] = glm::vec3(100);  // at the seam: its left neighbour is the last column
    const auto texels = environmentTable(map);
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) EXPECT_GT(texels[std::size_t((4 + dy) * 16 + (dx + 16) % 16)].density, 0) << dx << " " << dy;
    EXPECT_EQ(texels[4 * 16 + 2].density, 0);
}

TEST(Mipmaps, HalvesDownToOneTexelInLinearLight) {
    Texture texture{.name = "checker", .width = 4, .height = 2, .rgba = {}, .srgb = true};
    for (int i = 0; i < 8; ++i) texture.rgba.insert(texture.rgba.end(), 3, (i + i / 4) % 2 ? 255 : 0), texture.rgba.push_back(255);
    std::vector<std::uint32_t> texels(3, 7u);
    EXPECT_EQ(appendMipmaps(texture, texels), 3u);
    ASSERT_EQ(texels.size(), 3u + 8u + 2u + 1u);
    // Half black, half white is 0.5 in linear light, which sRGB encodes as 188.
    for (std::size_t i = 3 + 8; i < texels.size(); ++i) EXPECT_EQ(texels[i], 0xffbcbcbcu);
}
