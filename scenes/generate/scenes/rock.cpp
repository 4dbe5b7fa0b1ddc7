// SPDX-License-Identifier: MIT
// A weathered rock on a heath in the evening: the rock and its smaller kin share one mesh; stones, pebbles and tufts are instances.
#include <cmath>
#include <string>
#include <vector>

#include "kit/glb.h"
#include "kit/grass.h"
#include "kit/random.h"
#include "kit/scene.h"
#include "kit/stone.h"
#include "kit/terrain.h"

namespace lodestir::generate {

namespace {

constexpr int rockCells = 80;  ///< 12 * 80^2 = 76,800 triangles; halves evenly four times
constexpr int chartTexels = 512;

/// Turned about the vertical, then tipped to stand square on a slope.
glm::quat standing(const glm::vec3& normal, float degrees) {
    const glm::vec3 up(0, 1, 0), axis = glm::cross(up, normal);
    const float sine = glm::length(axis);
    const glm::quat tip = sine > 1e-5f ? glm::angleAxis(std::asin(std::min(sine, 1.0f)), axis / sine) : glm::quat(1, 0, 0, 0);
    return tip * turnY(degrees);
}

/// The hero stands at the origin; no small thing may start inside its foot.
bool insideRock(const glm::vec2& xz, float margin) {
    const glm::vec2 q = xz / (glm::vec2(1.62f, 1.30f) + margin);
    return glm::dot(q, q) < 1;
}

void addRocks(Glb& glb, const Terrain& terrain, int material, const Mesh& mesh) {
    const int rock = glb.addMesh("rock", mesh, material);
    glb.addNode("rock", rock, {.translation = {0, 0.78f, 0}});
    struct Kin {
        glm::vec2 xz;
        float turn, scale, sunk;
    };
    const Kin kin[] = {{{2.55f, -1.25f}, 140, 0.42f, 0.18f}, {{-2.5f, 0.75f}, 215, 0.27f, 0.12f}, {{-5.2f, -7.5f}, 80, 0.75f, 0.3f},
                       {{9.5f, -19}, 250, 1.5f, 0.4f},       {{-19, -34}, 20, 2.2f, 0.9f},        {{26, -52}, 160, 3.0f, 1.0f}};
    int number = 2;
    for (const Kin& k : kin) {
        const glm::vec3 place(k.xz.x, terrain.height(k.xz) + 0.92f * k.scale - k.sunk * k.scale, k.xz.y);
        glb.addNode("rock_" + std::to_string(number++), rock,
                    {.translation = place, .rotation = standing(terrain.normal(k.xz), k.turn), .scale = glm::vec3(k.scale)});
    }
}

/// Stones of three shapes and pebbles of four, all wearing the rock's pictures: their charts lie in the same atlas.
void addStones(Glb& glb, const Terrain& terrain, int material) {
    const auto variants = [&](const std::string& name, int count, int cells, uint32_t seed) {
        std::vector<int> meshes;
        for (int i = 0; i < count; ++i) {
            Random random(seed + uint32_t(i));
            const StoneForm form{.size = {1, random.between(0.5f, 0.75f), random.between(0.7f, 0.95f)},
                                 .facets = 14,
                                 .sharpness = random.between(5, 10),
                                 .relief = 0.8f};
            meshes.push_back(glb.addMesh(name + "_" + std::to_string(i), Stone(seed + uint32_t(i), form).mesh(cells), material));
        }
        return meshes;
    };
    const auto scatter = [&](const std::string& name, const std::vector<int>& meshes, int count, float reach, float smallest, float largest,
                             uint32_t seed) {
        Random random(seed);
        for (int placedCount = 0; placedCount < count;) {
            // Denser towards the rock: debris falls from it.
            const float r = 1.2f + (reach - 1.2f) * std::pow(random.next(), 1.6f), a = random.between(0, 6.2831853f);
            const glm::vec2 xz(r * std::cos(a), r * std::sin(a));
            const float scale = smallest * std::pow(largest / smallest, std::pow(random.next(), 2.2f));
            const float turn = random.between(0, 360);
            const int mesh = meshes[size_t(random.below(int(meshes.size())))];
            if (insideRock(xz, scale * 0.5f)) continue;
            glb.addNode(name + "_" + std::to_string(placedCount++), mesh,
                        {.translation = {xz.x, terrain.height(xz) + scale * 0.22f, xz.y},
                         .rotation = standing(terrain.normal(xz), turn),
                         .scale = glm::vec3(scale)});
        }
    };
    scatter("stone", variants("stone", 3, 20, 300), 34, 11, 0.07f, 0.30f, 41);
    scatter("pebble", variants("pebble", 4, 6, 400), 420, 8, 0.012f, 0.055f, 42);
}

/// Tufts, swards of a metre across, and shrubs farther off.
void addPlants(Glb& glb, const Terrain& terrain) {
    const int blade = glb.addMaterial({.name = "grass", .roughness = 0.75f, .doubleSided = true});
    const auto grow = [&](const std::string& name, const std::vector<Mesh>& meshes) {
        std::vector<int> ids;
        for (const Mesh& mesh : meshes)
            ids.push_back(glb.addMesh(name + "_mesh_" + std::to_string(ids.size()), mesh, blade));
        return ids;
    };
    struct Spread {
        int count;
        float nearest, farthest, power;  ///< distances from the rock in metres; a power above 1/2 crowds the middle
        float smallest, largest;
        bool keepsToMeadow;
    };
    const auto scatter = [&](const std::string& name, const std::vector<int>& meshes, const Spread& spread, uint32_t seed) {
        Random random(seed);
        for (int number = 0; number < spread.count;) {
            const float r = spread.nearest + (spread.farthest - spread.nearest) * std::pow(random.next(), spread.power),
                        a = random.between(0, 6.2831853f);
            const glm::vec2 xz(r * std::cos(a), r * std::sin(a));
            const float chance = random.next(), scale = random.between(spread.smallest, spread.largest), turn = random.between(0, 360);
            const int mesh = meshes[size_t(random.below(int(meshes.size())))];
            // A skirt of grass stands around the foot of the rock, where rain runs off.
            const float skirt = insideRock(xz, 0.35f) ? 0.8f : 0.0f;
            if (insideRock(xz, -0.08f) || (spread.keepsToMeadow && chance > std::max(terrain.meadow(xz), skirt))) continue;
            glb.addNode(name + "_" + std::to_string(number++), mesh,
                        {.translation = {xz.x, terrain.height(xz), xz.y},
                         .rotation = standing(terrain.normal(xz), turn),
                         .scale = glm::vec3(scale)});
        }
    };
    const std::vector<int> tufts = grow("tuft", {grassTuft(600, {64, 0.20f, 0.08f, 0.75f}), grassTuft(601, {80, 0.30f, 0.09f, 0.85f}),
                                                 grassTuft(602, {50, 0.13f, 0.07f, 0.35f}), grassTuft(603, {90, 0.38f, 0.10f, 0.65f})});
    const std::vector<int> swards = grow("sward", {grassTuft(610, {420, 0.13f, 0.55f, 0.55f}), grassTuft(611, {380, 0.17f, 0.60f, 0.75f})});
    const std::vector<int> shrubs = grow("shrub", {shrub(620, 2600), shrub(621, 2200)});
    scatter("tuft", tufts, {800, 1.0f, 16, 0.75f, 0.7f, 1.35f, true}, 77);
    scatter("sward", swards, {420, 1.4f, 26, 0.62f, 0.8f, 1.5f, true}, 78);
    scatter("shrub", shrubs, {90, 11, 90, 0.8f, 0.8f, 2.2f, false}, 79);
}

Glb makeRock() {
    Glb glb;
    const Stone stone(20, {.size = {1.62f, 1.32f, 1.36f}, .facets = 15, .sharpness = 24, .relief = 1});
    const Mesh mesh = stone.mesh(rockCells);
    const int material = glb.addMaterial(glb.dressed({.name = "rock"}, stone.bake(mesh, chartTexels)));
    const Terrain terrain(8);

    addRocks(glb, terrain, material, mesh);
    addStones(glb, terrain, material);
    addPlants(glb, terrain);

    Model ground{"terrain", {}};
    ground.add(glb.addMaterial(glb.dressed({.name = "ground"}, paintGround(3, 1024))), terrain.mesh(256));
    glb.addNode(ground);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeRock, "--levels 4 --ratio 4 --mesh rock")

}  // namespace lodestir::generate
