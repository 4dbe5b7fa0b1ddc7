// SPDX-License-Identifier: MIT
// Scenes for impostors hold what impostors are judged by in them: one thing that fills the picture, a plain ground behind it, light of three kinds, and what
// each scene is named for. Pictures look right without.
#include "source_folder.h"

#include <framework/core/error.h>
#include <framework/scene/environment.h>
#include <framework/scene/scene.h>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

namespace lodestir::test {
namespace {

constexpr float side = 512;  ///< of the square picture that these scenes are framed for, pixels

Scene loaded(const std::string& name) { return loadScene(sourceFolder / "scenes" / (name + ".json")); }

glm::mat4 viewOf(const CameraKey& camera) { return glm::lookAt(camera.position, camera.target, camera.up); }

/// Where the camera shows a point: [-1, 1] is the picture.
glm::vec2 shownAt(const CameraKey& camera, const glm::vec3& p) {
    const glm::vec3 seen(viewOf(camera) * glm::vec4(p, 1));
    return glm::vec2(seen) / (-seen.z * std::tan(0.5f * camera.fovy));
}

const Instance& instanceNamed(const Scene& scene, const std::string& name) {
    const auto found = std::ranges::find(scene.instances, name, &Instance::name);
    if (found == scene.instances.end()) throw Error("no instance " + name);
    return *found;
}

const MeshLevel& finestOf(const Scene& scene, const std::string& instance) { return scene.meshes[instanceNamed(scene, instance).mesh].levels.front(); }

std::vector<glm::vec3> pointsOf(const Scene& scene, const Instance& instance) {
    const glm::mat4 place = scene.instanceMatrix(instance, scene.nodeMatrices(0));
    std::vector<glm::vec3> points;
    for (const glm::vec3& p : scene.meshes[instance.mesh].levels.front().positions) points.emplace_back(place * glm::vec4(p, 1));
    return points;
}

/// Materials that triangles of an instance wear.
std::set<std::uint32_t> wornBy(const Scene& scene, const std::string& instance) {
    const MeshLevel& level = finestOf(scene, instance);
    return {level.materials.begin(), level.materials.end()};
}

struct Object {
    const char* scene;
    const char* name;
    std::size_t fewest, most;  ///< triangles
    std::size_t levels;
};

std::ostream& operator<<(std::ostream& out, const Object& object) { return out << object.scene; }

// If this fails, errors of the thing are diluted by what is around it, or cut off by the picture's edge.
void expectOneThingThatFillsTheSquare(const Scene& scene, const Object& object) {
    ASSERT_EQ(scene.instances.size(), 2u);  // and the lamp
    const CameraKey camera = scene.cameraAt(0);
    glm::vec2 low(1e9f), high(-1e9f);
    for (const glm::vec3& p : pointsOf(scene, instanceNamed(scene, object.name))) {
        low = glm::min(low, shownAt(camera, p));
        high = glm::max(high, shownAt(camera, p));
    }
    EXPECT_GT(std::min(low.x, low.y), -0.97f);
    EXPECT_LT(std::max(high.x, high.y), 0.97f);
    const float span = std::max(high.x - low.x, high.y - low.y) / 2;
    EXPECT_GT(span, 0.80f);
    EXPECT_LT(span, 0.92f);
}

void expectTrianglesAndLevels(const Scene& scene, const Object& object) {
    const Mesh& mesh = scene.meshes[instanceNamed(scene, object.name).mesh];
    EXPECT_GE(mesh.levels.front().triangles.size(), object.fewest);
    EXPECT_LE(mesh.levels.front().triangles.size(), object.most);
    EXPECT_EQ(mesh.levels.size(), object.levels);
}

// An impostor that is shaded anew has to meet light from afar, from a lamp with extent and from one without.
void expectThreeLightsOutOfSight(const Scene& scene, const Object& object) {
    EXPECT_EQ(scene.environment.type, EnvironmentType::sky);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].type, LightType::point);
    for (std::uint32_t material : wornBy(scene, "lamp")) EXPECT_TRUE(scene.materials[material].isLight());
    for (std::uint32_t material : wornBy(scene, object.name)) EXPECT_FALSE(scene.materials[material].isLight());
    const CameraKey camera = scene.cameraAt(0);
    glm::vec2 low(1e9f), high(-1e9f);  // a convex sheet is out of sight when all of it lies beyond one side
    for (const glm::vec3& p : pointsOf(scene, instanceNamed(scene, "lamp"))) {
        ASSERT_LT((viewOf(camera) * glm::vec4(p, 1)).z, 0) << "behind the camera, where the sides say nothing";
        low = glm::min(low, shownAt(camera, p));
        high = glm::max(high, shownAt(camera, p));
    }
    EXPECT_TRUE(low.x > 1 || low.y > 1 || high.x < -1 || high.y < -1);
}

// What is seen past the thing is one colour: whatever differs there is the impostor's.
void expectAPlainGround(const Scene& scene) {
    const CameraKey camera = scene.cameraAt(0);
    const glm::mat4 toWorld = glm::inverse(viewOf(camera));
    const auto radianceAt = [&](const glm::vec2& film) {
        const glm::vec3 direction(toWorld * glm::vec4(film * std::tan(0.5f * camera.fovy), -1, 0));
        const glm::vec2 uv = environmentUv(glm::normalize(direction), scene.environment.rotation);
        const auto x = std::min(int(uv.x * float(scene.environment.width)), scene.environment.width - 1),
                   y = std::min(int(uv.y * float(scene.environment.height)), scene.environment.height - 1);
        return scene.environment.radiance[std::size_t(y) * std::size_t(scene.environment.width) + std::size_t(x)];
    };
    const glm::vec3 middle = radianceAt({0, 0});
    EXPECT_GT(middle.g, 0.01f);
    for (float x = -1; x <= 1; x += 0.25f)
        for (float y = -1; y <= 1; y += 0.25f) EXPECT_LT(glm::distance(radianceAt({x, y}), middle), 0.1f * glm::length(middle)) << x << " " << y;
}

class ImpostorScene : public testing::TestWithParam<Object> {};

TEST_P(ImpostorScene, ShowsOneThingByItself) {
    const Scene scene = loaded(GetParam().scene);
    expectOneThingThatFillsTheSquare(scene, GetParam());
    expectTrianglesAndLevels(scene, GetParam());
    expectThreeLightsOutOfSight(scene, GetParam());
    expectAPlainGround(scene);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ImpostorScene,
                         testing::Values(Object{"deer", "deer", 25000, 40000, 4}, Object{"bunny", "bunny", 200000, 500000, 5},
                                         Object{"mirror", "mirror", 100000, 500000, 4}, Object{"teapot", "teapot", 100000, 500000, 4},
                                         Object{"foliage", "foliage", 20000, 200000, 1}, Object{"impostor_sphere", "sphere", 95000, 105000, 5},
                                         Object{"impostor_torus", "torus", 10000, 100000, 4}, Object{"impostor_bowls", "bowls", 10000, 200000, 4},
                                         Object{"impostor_wires", "wires", 1000, 10000, 1}, Object{"impostor_checker", "checker", 320000, 320000, 1},
                                         Object{"impostor_seam", "seam", 1000, 10000, 1}, Object{"impostor_bumps", "bumps", 10000, 100000, 1}),
                         [](const auto& object) { return std::string(object.param.scene); });

TEST(ImpostorScenes, TheMirrorReflectsAndDoesNothingElse) {
    const Scene scene = loaded("mirror");
    for (std::uint32_t id : wornBy(scene, "mirror")) {
        EXPECT_EQ(scene.materials[id].metallic, 1);
        EXPECT_LE(scene.materials[id].roughness, 0.1f);
        EXPECT_EQ(scene.materials[id].normalMap.texture, none);
    }
}

TEST(ImpostorScenes, TheTeapotIsNormalMappedAndItsGlossVaries) {
    const Scene scene = loaded("teapot");
    for (std::uint32_t id : wornBy(scene, "teapot")) {
        const Material& material = scene.materials[id];
        ASSERT_NE(material.normalMap.texture, none) << material.name;
        ASSERT_NE(material.metallicRoughnessMap.texture, none) << material.name;
        const Texture& picture = scene.textures[material.metallicRoughnessMap.texture];
        std::uint8_t low = 255, high = 0;
        for (std::size_t i = 1; i < picture.rgba.size(); i += 4) low = std::min(low, picture.rgba[i]), high = std::max(high, picture.rgba[i]);
        EXPECT_GE(low, 50) << material.name;    // 0.2 in eight bits is 51
        EXPECT_LE(high, 128) << material.name;  // 0.5
        EXPECT_GT(high - low, 40) << material.name;
    }
}

TEST(ImpostorScenes, LeavesAreCutOutAndSeenFromBothSides) {
    const Scene scene = loaded("foliage");
    const MeshLevel& level = finestOf(scene, "foliage");
    const auto leaves = std::ranges::count_if(
        level.materials, [&](std::uint32_t id) { return scene.materials[id].alphaMode == AlphaMode::mask && scene.materials[id].doubleSided; });
    EXPECT_GT(double(leaves), 0.5 * double(level.materials.size()));
}

TEST(ImpostorScenes, BumpsAreNoiseOnAGlossOfAlphaOneTwentieth) {
    const Scene scene = loaded("impostor_bumps");
    for (std::uint32_t id : wornBy(scene, "bumps")) {
        const Material& material = scene.materials[id];
        EXPECT_NEAR(material.roughness * material.roughness, 0.05f, 1e-4f);
        ASSERT_NE(material.normalMap.texture, none);
        // The mean of the normals is upright, and a good way shorter than they are: that is what an average would lose.
        const Texture& picture = scene.textures[material.normalMap.texture];
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
            sum += glm::normalize(glm::dvec3(picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2]) / 127.5 - 1.0);
        sum *= 4.0 / double(picture.rgba.size());
        EXPECT_LT(glm::length(glm::dvec2(sum)), 0.01);
        EXPECT_LT(glm::length(sum), 0.98);
    }
}

// If this fails, what is said of wires of a width is said of others.
TEST(ImpostorScenes, WiresGoFromHalfAPixelToFour) {
    const Scene scene = loaded("impostor_wires");
    const CameraKey camera = scene.cameraAt(0);
    // Upper ends of upright wires, from left to right: a ring of points each.
    std::vector<glm::vec3> ends;
    for (const glm::vec3& p : pointsOf(scene, instanceNamed(scene, "wires")))
        if (std::abs(p.y - 0.9f) < 1e-5f) ends.push_back(p);
    std::ranges::sort(ends, {}, &glm::vec3::x);
    std::vector<std::vector<glm::vec3>> rings;
    for (const glm::vec3& p : ends) {
        if (rings.empty() || p.x - rings.back().front().x > 0.03f) rings.emplace_back();
        rings.back().push_back(p);
    }
    std::vector<float> widths;
    for (const auto& ring : rings) {
        const auto [left, right] = std::ranges::minmax_element(ring, {}, &glm::vec3::x);
        const glm::vec3 middle(0.5f * (left->x + right->x), 0, 0);
        const float depth = -(viewOf(camera) * glm::vec4(middle, 1)).z;
        widths.push_back((right->x - left->x) / (2 * depth * std::tan(0.5f * camera.fovy)) * side);
    }
    ASSERT_EQ(widths.size(), 22u);
    EXPECT_TRUE(std::ranges::is_sorted(widths));
    EXPECT_NEAR(widths.front(), 0.5f, 0.05f);
    EXPECT_NEAR(widths.back(), 4.0f, 0.2f);
}

TEST(ImpostorScenes, CellsOfTheCheckerAreSmallerThanTexelsAndAllAlikeInShare) {
    const Scene scene = loaded("impostor_checker");
    const MeshLevel& level = finestOf(scene, "checker");
    std::map<std::uint32_t, std::size_t> shares;
    for (std::uint32_t id : level.materials) ++shares[id];
    EXPECT_EQ(shares.size(), 8u);
    for (const auto& [id, count] : shares) EXPECT_EQ(count, level.materials.size() / 8);
    glm::vec3 low(1e9f), high(-1e9f);
    for (const glm::vec3& p : level.positions) low = glm::min(low, p), high = glm::max(high, p);
    const float cell = (high.x - low.x) / std::sqrt(float(level.triangles.size()) / 2), texel = glm::distance(low, high) / 254;
    EXPECT_LT(cell, 0.5f * texel);
}

// The control: a mean of texture coordinates over a seam has to find the colour that no place of the surface has.
TEST(ImpostorScenes, MeansAcrossSeamsAreMagentaWhichTheSurfaceIsNot) {
    const Scene scene = loaded("impostor_seam");
    const MeshLevel& level = finestOf(scene, "seam");
    const Texture& picture = scene.textures[scene.materials[*wornBy(scene, "seam").begin()].baseColorMap.texture];
    const auto isMagenta = [&](const glm::vec2& uv) {
        const glm::vec2 p = glm::fract(uv) * glm::vec2(picture.width, picture.height);
        const std::uint8_t* texel = picture.rgba.data() + 4 * (std::size_t(p.y) * std::size_t(picture.width) + std::size_t(p.x));
        return texel[0] > texel[1] + 60 && texel[2] > texel[1] + 60;
    };
    std::size_t magenta = 0, beyondOne = 0;
    for (const glm::uvec3& t : level.triangles)
        for (int i = 0; i <= 8; ++i)
            for (int j = 0; i + j <= 8; ++j) {
                const float a = float(i) / 8, b = float(j) / 8;
                const glm::vec2 uv = a * level.uv0[t.x] + b * level.uv0[t.y] + (1 - a - b) * level.uv0[t.z];
                magenta += isMagenta(uv), beyondOne += uv.x > 1;
            }
    EXPECT_EQ(magenta, 0u);
    EXPECT_GT(beyondOne, 100u);

    std::map<std::array<long, 3>, std::vector<glm::vec2>> places;
    for (std::size_t i = 0; i < level.positions.size(); ++i) {
        const glm::vec3 p = level.positions[i] * 1e4f;
        places[{std::lround(p.x), std::lround(p.y), std::lround(p.z)}].push_back(level.uv0[i]);
    }
    std::size_t seams = 0, found = 0;
    for (const auto& [place, uvs] : places)
        for (const glm::vec2& uv : uvs)
            if (glm::distance(glm::fract(uv), glm::fract(uvs.front())) > 0.1f) ++seams, found += isMagenta(0.5f * (glm::fract(uv) + glm::fract(uvs.front())));
    EXPECT_GT(seams, 50u);
    EXPECT_GT(double(found), 0.9 * double(seams));
}

TEST(ImpostorScenes, TheFieldHasTenThousandThingsAtAllDistances) {
    const Scene scene = loaded("impostor_field");
    const glm::vec3 eye = scene.cameraAt(0).position;
    const auto nodes = scene.nodeMatrices(0);
    std::map<std::string, std::size_t> counts;
    std::map<int, std::size_t> octaves;  // of distance
    for (const Instance& instance : scene.instances) {
        ++counts[scene.meshes[instance.mesh].name];
        if (scene.meshes[instance.mesh].name == "terrain") continue;
        const glm::mat4 place = scene.instanceMatrix(instance, nodes);
        ++octaves[int(std::floor(std::log2(glm::distance(glm::vec3(place[3]), eye))))];
    }
    EXPECT_EQ(scene.instances.size(), 10001u);
    EXPECT_EQ(counts.size(), 6u);
    for (const char* name : {"deer", "rabbit", "bush", "tree", "boulder"}) EXPECT_GT(counts[name], 100u) << name;
    for (int octave = 3; octave <= 8; ++octave) EXPECT_GT(octaves[octave], 200u) << "from " << (1 << octave) << " m";
}

}  // namespace
}  // namespace lodestir::test
