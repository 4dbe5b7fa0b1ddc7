// SPDX-License-Identifier: MIT
// A village on a hill as if in watercolour: nothing shines, everything is textured, and the camera rises from the lane over the roofs.
#include <algorithm>
#include <cmath>
#include <string>

#include "kit/cottage.h"
#include "kit/grass.h"
#include "kit/noise.h"
#include "kit/random.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/tree.h"
#include "kit/watercolour.h"

namespace lodestir::generate {

namespace {

const Noise relief{91};

/// Middle of the lane.
float laneAt(float z) { return 2.3f * std::sin(0.13f * z + 0.4f); }

float heightAt(const glm::vec2& p) {
    const float lane = glm::smoothstep(1.2f, 3.5f, std::abs(p.x - laneAt(p.y)));
    const float hill =
        5.2f * glm::smoothstep(12.0f, -34.0f, p.y) + 9.0f * glm::smoothstep(-40.0f, -95.0f, p.y) * (0.7f + 0.5f * relief.at({p.x * 0.02f, 0.5f, 3.5f}));
    return hill + (0.15f + 0.85f * lane) * 0.55f * relief.fractal({p.x * 0.09f, 0.5f, p.y * 0.09f}, 4);
}

glm::vec3 onGround(float x, float z) { return {x, heightAt({x, z}), z}; }

void addGround(Glb& glb, int meadow, int lane) {
    Model ground{"meadow", {}};
    Mesh hill = grid(150, 150, [](float u, float v) { return onGround(-75 + 150 * u, -110 + 140 * v); });
    for (Vertex& v : hill.vertices) {
        v.uv = glm::vec2(v.position.x, v.position.z) / washSize;
        const float patch = relief.fractal(glm::vec3(v.position.x, 7, v.position.z) * 0.06f, 4, 0.6f), far = glm::smoothstep(-25.0f, -95.0f, v.position.z);
        const glm::vec3 sap(0.26f, 0.38f, 0.10f), olive(0.42f, 0.42f, 0.13f), ochre(0.60f, 0.50f, 0.20f), mist(0.30f, 0.42f, 0.42f);
        v.color = glm::mix(glm::mix(sap, olive, glm::smoothstep(-0.3f, 0.15f, patch)), ochre, glm::smoothstep(0.12f, 0.45f, patch));
        v.color = glm::mix(v.color, mist, 0.8f * far);
    }
    hill.hasColors = true;
    ground.add(meadow, hill);
    Mesh way = grid(8, 110, [](float u, float v) {
        const float z = 28 - 66 * v, x = laneAt(z) + (u - 0.5f) * (2.3f + 0.35f * relief.at({z * 0.6f, 3.5f, 0.5f}));
        return onGround(x, z) + glm::vec3(0, 0.05f - 0.12f * std::abs(2 * u - 1) * std::abs(2 * u - 1) * std::abs(2 * u - 1), 0);
    });
    for (Vertex& v : way.vertices) v.uv = glm::vec2(v.position.x, v.position.z) / washSize;
    ground.add(lane, way);
    glb.addNode(ground);

    // Ranges beyond, paler the farther: each a sheet that stands behind the last.
    const glm::vec3 blues[] = {{0.20f, 0.32f, 0.34f}, {0.30f, 0.42f, 0.50f}, {0.46f, 0.56f, 0.66f}};
    for (int i = 0; i < 3; ++i) {
        const float z = -130 - 70 * float(i), width = 500 + 200 * float(i);
        Model range{"range_" + std::to_string(i), {}};
        Mesh sheet = grid(110, 6, [&](float u, float v) {
            const float x = (u - 0.5f) * width;
            const float crest = 16 + 15 * float(i) + (14 + 7 * float(i)) * relief.fractal({x * 0.009f + 31 * float(i), 0.5f, 2.5f}, 5, 0.5f);
            return glm::vec3(x, crest * (1 - v) - 8 * v, z + 45 * v);
        });
        for (Vertex& v : sheet.vertices)
            v.uv = glm::vec2(v.position.x, v.position.y) / 40.0f, v.color = glm::mix(blues[i], glm::vec3(0.62f, 0.66f, 0.62f), 0.55f * v.uv.y);
        sheet.hasColors = true;
        range.add(meadow, sheet);
        glb.addNode(range);
    }
}

/// Heaps of round clouds, flat below.
void addClouds(Glb& glb, int white) {
    Random random(33);
    for (int i = 0; i < 9; ++i) {
        Model cloud{"cloud_" + std::to_string(i), {}};
        const float size = random.between(9, 17);
        for (int k = 0; k < 9; ++k) {
            const float along = random.between(-1, 1), r = size * (0.75f - 0.45f * std::abs(along)) * random.between(0.7f, 1.1f);
            const glm::vec3 middle(2.1f * size * along, 0.25f * r, random.between(-0.5f, 0.5f) * size);
            Mesh puff = bent(
                sphere(28, 14),
                [&](const glm::vec3& p) {
                    const glm::vec3 q = p * (1 + 0.22f * relief.fractal(p * 1.4f + 9.0f * float(9 * i + k), 3));
                    return middle + r * glm::vec3(q.x, q.y > 0 ? 0.8f * q.y : 0.25f * q.y, q.z);
                },
                180);
            cloud.add(white, puff);
        }
        glb.addNode(cloud, {.translation = {-185 + 46 * float(i) + random.between(-14, 14), random.between(52, 92), random.between(-250, -190)}});
    }
}

void addHouses(Glb& glb, const Material& paper, const Material& tiles) {
    const auto paint = [&](const std::string& name, const glm::vec3& color) { return glb.addMaterial(wash(paper, name, color)); };
    const auto roof = [&](const std::string& name, const glm::vec3& color) { return glb.addMaterial(wash(tiles, name, color)); };
    const int trim = paint("trim", {0.86f, 0.83f, 0.76f}), pane = paint("pane", {0.075f, 0.11f, 0.17f}), brick = paint("brick", {0.52f, 0.26f, 0.17f});
    const int walls[] = {paint("rose", {0.82f, 0.52f, 0.43f}), paint("ochre", {0.86f, 0.66f, 0.32f}), paint("sky", {0.52f, 0.66f, 0.76f}),
                         paint("lime", {0.88f, 0.85f, 0.76f}), paint("sage", {0.58f, 0.66f, 0.48f})};
    const int roofs[] = {roof("vermilion", {0.72f, 0.25f, 0.13f}), roof("indigo", {0.24f, 0.28f, 0.40f}), roof("umber", {0.48f, 0.30f, 0.19f})};
    const int shutters[] = {paint("cobalt", {0.10f, 0.22f, 0.52f}), paint("viridian", {0.08f, 0.33f, 0.26f}), paint("crimson", {0.55f, 0.08f, 0.09f})};
    struct House {
        float x, z, turn;
        glm::vec3 size;
        int wall, roof, shutter;
        float pitch;
    };
    const House houses[] = {{-7.2f, 3.2f, 62, {6.2f, 2.8f, 4.6f}, 1, 0, 0, 1.0f},   {7.4f, -0.5f, -64, {5.4f, 5.3f, 4.4f}, 0, 1, 1, 1.1f},
                            {-6.6f, -7.2f, 72, {5.2f, 5.3f, 4.4f}, 2, 0, 2, 1.0f},  {6.0f, -10.5f, -80, {6.4f, 2.9f, 4.6f}, 3, 2, 0, 1.15f},
                            {-5.2f, -17.5f, 48, {6.0f, 2.9f, 4.4f}, 4, 2, 2, 1.0f}, {8.5f, -19.5f, -42, {5.4f, 5.2f, 4.4f}, 1, 0, 1, 1.05f},
                            {15.5f, -6.5f, -30, {5.6f, 2.8f, 4.2f}, 2, 0, 2, 1.1f}, {-15, -13, 30, {6.4f, 2.8f, 4.6f}, 3, 1, 1, 1.0f},
                            {-14.5f, -27, 25, {5.4f, 5.2f, 4.4f}, 0, 2, 0, 1.1f},   {17, -28, -20, {6.2f, 2.8f, 4.6f}, 4, 0, 0, 1.0f}};
    for (size_t i = 0; i < std::size(houses); ++i) {
        const House& h = houses[i];
        const std::string name = "house_" + std::to_string(i);
        glb.addNode(cottage(name, {walls[h.wall], roofs[h.roof], trim, shutters[h.shutter], pane, brick}, h.size, h.pitch),
                    {.translation = onGround(h.x, h.z), .rotation = turnY(h.turn)});
    }
    glb.addNode(church("church", {walls[3], roofs[1], trim, shutters[2], pane, brick}), {.translation = onGround(2.5f, -33), .rotation = turnY(-28)});

    // Fences along the lane's near end.
    Model fence{"fence", {}};
    for (float side : {-1.0f, 1.0f})
        for (float z = 13; z > -16; z -= 0.42f) {
            if (std::abs(z - (side < 0 ? 3.5f : -1.5f)) < 1.3f || std::abs(z + 8.2f) < 1.2f) continue;  // gates
            const glm::vec3 foot = onGround(laneAt(z) + side * 2.1f, z);
            const float lean = 0.03f * relief.at({z * 3, side, 0.5f});
            fence.add(trim, placed(roundedBox({0.05f, 0.95f + lean, 0.11f}, 0.02f, 1), foot + glm::vec3(lean, 0.42f, 0)));
            const glm::vec3 next = onGround(laneAt(z - 0.42f) + side * 2.1f, z - 0.42f);
            for (float y : {0.3f, 0.68f}) fence.add(trim, bar(foot + glm::vec3(-0.03f * side, y, 0), next + glm::vec3(-0.03f * side, y, 0), 0.028f, 5));
        }
    glb.addNode(fence);
}

void addPlants(Glb& glb, int dabs) {
    Random random(17);
    const auto add = [&](const std::string& name, const Mesh& mesh) { return glb.addMesh(name, mesh, dabs); };
    const int broad[] = {
        add("linden", tree(1, {})),
        add("oak", tree(2, {.height = 6,
                            .spread = 2.3f,
                            .dabs = 2000,
                            .dab = 0.2f,
                            .shade = {0.05f, 0.07f, 0.04f},
                            .light = {0.30f, 0.34f, 0.09f},
                            .accent = {0.52f, 0.46f, 0.12f}})),
        add("maple", tree(3, {.height = 5, .spread = 1.9f, .shade = {0.20f, 0.05f, 0.03f}, .light = {0.62f, 0.22f, 0.05f}, .accent = {0.80f, 0.48f, 0.10f}}))};
    const int cherry = add("cherry", tree(4, generate::cherry(4.8f, 2.3f, 2600, 0.15f)));
    const int poplar = add("poplar", tree(5, {.height = 9,
                                              .spread = 1.05f,
                                              .waist = 0.4f,
                                              .bare = 0.1f,
                                              .dabs = 1800,
                                              .shade = {0.04f, 0.08f, 0.05f},
                                              .light = {0.18f, 0.30f, 0.10f},
                                              .accent = {0.36f, 0.42f, 0.14f}}));
    int number = 0;
    const auto plant = [&](int mesh, float x, float z, float scale) {
        glb.addNode("tree_" + std::to_string(number++), mesh,
                    {.translation = onGround(x, z), .rotation = turnY(random.between(0, 360)), .scale = glm::vec3(scale)});
    };
    plant(cherry, 4.6f, 5.2f, 1.0f), plant(cherry, -11.5f, -1.5f, 1.05f), plant(broad[0], -3.9f, -2.3f, 0.8f), plant(broad[2], 10.2f, 5.6f, 1.1f),
        plant(broad[1], -12.8f, 6.5f, 1.1f);
    plant(broad[2], 3.3f, -15.5f, 0.85f), plant(cherry, -9.5f, -21.5f, 1.0f), plant(broad[1], 12.2f, -14, 1.0f), plant(broad[0], -1.4f, -24.5f, 1.0f),
        plant(broad[2], -10.5f, -11.5f, 0.9f);
    for (int i = 0; i < 7; ++i) plant(poplar, -24.0f + 2.2f * float(i), -38 + 1.2f * float(i % 3), random.between(0.8f, 1.1f));
    for (int i = 0; i < 4; ++i) plant(poplar, 13.5f + 2.0f * float(i), -36 - 0.8f * float(i), random.between(0.8f, 1.1f));
    while (number < 82) {
        const float z = random.between(-95, 6), x = random.between(-1, 1) * (18 + 0.55f * std::max(-z, 0.0f));
        if (std::abs(x) < (z > -32 ? 18.5f : 9.0f)) continue;
        plant(broad[random.below(3)], x, z, random.between(0.7f, 1.25f));
    }

    const auto bed = [&](const Flower& flower, int count) { return add(flower.name, flowerPatch(flower, count, 0.9f)); };
    const int patches[] = {bed(poppies, 46), bed(cornflowers, 46), bed(buttercups, 52)};
    const int grass[] = {add("grass", grassTuft(21, {300, 0.26f, 0.55f, 0.12f})), add("tall_grass", grassTuft(22, {240, 0.42f, 0.5f, 0.3f}))};
    const auto scatter = [&](const std::string& name, const int* meshes, int kinds, int count, float low, float high) {
        for (int i = 0; i < count;) {
            const float z = 14 - 40 * std::pow(random.next(), 1.8f), x = laneAt(z) + random.between(-1, 1) * (4 + 0.75f * (17 - z));
            const float patch = relief.fractal({x * 0.2f, 5.5f, z * 0.2f}, 2);
            const float scale = random.between(low, high), turn = random.between(0, 360);
            if (std::abs(x - laneAt(z)) < 1.9f) continue;
            const int kind = std::clamp(int((0.5f + 1.4f * patch + random.between(-0.3f, 0.3f)) * float(kinds)), 0, kinds - 1);
            glb.addNode(name + std::to_string(i++), meshes[kind], {.translation = onGround(x, z), .rotation = turnY(turn), .scale = glm::vec3(scale)});
        }
    };
    scatter("flowers_", patches, 3, 330, 0.8f, 1.4f);
    scatter("sward_", grass, 2, 420, 0.8f, 1.3f);
}

Glb makeWatercolour() {
    Glb glb;
    const Material paper = glb.dressed({.name = "wash"}, paintWash(3, 768)), tiles = glb.dressed({.name = "roof"}, paintRoof(4, 512));
    addGround(glb, glb.addMaterial(wash(paper, "meadow", glm::vec3(1))), glb.addMaterial(wash(paper, "lane", {0.80f, 0.68f, 0.50f})));
    addClouds(glb, glb.addMaterial({.name = "cloud", .color = glm::vec3(0.9f), .ior = 1}));
    addHouses(glb, paper, tiles);
    addPlants(glb, glb.addMaterial(dabs()));
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeWatercolour)

}  // namespace lodestir::generate
