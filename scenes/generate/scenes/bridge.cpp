// SPDX-License-Identifier: MIT
// A bridge of two towers over a river after sunset, seen from a quay. A thousand lamps and windows light it; from any point most are far or hidden.
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "kit/gothic_tower.h"
#include "kit/lamps.h"
#include "kit/marble.h"
#include "kit/metals.h"
#include "kit/paving.h"
#include "kit/random.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/still_life.h"
#include "kit/truss.h"
#include "kit/water.h"

namespace lodestir::generate {

namespace {

// The bridge runs along x over a river that flows along z; the water's mean level is y = 0.
constexpr float road = 9.5f, halfRoad = 6.2f, bank = 118;
constexpr float towerX = 32, abutmentX = 102;
constexpr float walkway = road + 31;
const glm::vec3 towerSize(13, 38, 15.5f);

struct Paints {
    int granite, stone, trim, roof, gilt, glass, blue, white, iron, asphalt, water, brick, setts;
    int globe, window, flood, bead, red;
};

Paints addPaints(Glb& glb) {
    const auto glowing = [&](const std::string& name, const glm::vec3& radiance) {
        return glb.addMaterial({.name = name, .color = glm::vec3(0), .emission = radiance});
    };
    Paints p{};
    const Material ashlar = glb.dressed({.name = "ashlar"}, paintAshlar(glm::vec3(0.85f), 3, 768));
    const auto stone = [&](const std::string& name, const glm::vec3& color) {
        Material m = ashlar;
        m.name = name, m.color = color;
        return glb.addMaterial(m);
    };
    p.granite = stone("granite", {0.40f, 0.37f, 0.34f});
    p.stone = stone("sandstone", {0.66f, 0.57f, 0.43f});
    p.trim = stone("portland_stone", {0.82f, 0.77f, 0.67f});
    p.roof = stone("slate", {0.16f, 0.18f, 0.22f});
    p.brick = stone("brick", {0.20f, 0.15f, 0.13f});
    p.gilt = glb.addMaterial({.name = "gilt", .color = gold, .roughness = 0.3f, .metalness = 1});
    p.glass = glb.addMaterial({.name = "dark_glass", .color = glm::vec3(0.02f), .roughness = 0.08f});
    p.blue = glb.addMaterial({.name = "blue_paint", .color = {0.10f, 0.30f, 0.50f}, .roughness = 0.38f});
    p.white = glb.addMaterial({.name = "white_paint", .color = {0.78f, 0.79f, 0.78f}, .roughness = 0.4f});
    p.iron = glb.addMaterial({.name = "iron", .color = glm::vec3(0.025f, 0.030f, 0.032f), .roughness = 0.4f});
    p.asphalt = glb.addMaterial({.name = "asphalt", .color = glm::vec3(0.06f), .roughness = 0.7f});
    p.water = glb.addMaterial({.name = "water", .color = {0.010f, 0.020f, 0.022f}, .roughness = 0.10f, .ior = 1.333f});
    p.setts = glb.addMaterial(glb.dressed({.name = "wet_setts"}, paintWetSetts(9, 768)));
    p.globe = glowing("lamp_globe", {34, 21, 9.5f});
    p.window = glowing("lit_window", {7, 3.9f, 1.5f});
    p.flood = glowing("floodlight", {330, 215, 110});
    p.bead = glowing("lamp_bead", {60, 40, 20});
    p.red = glowing("red_lamp", {40, 3, 1.5f});
    return p;
}

Mesh inBlocks(Mesh mesh) {
    scaleUv(mesh, glm::vec2(1 / ashlarSize));
    return mesh;
}

/// Piers with pointed cutwaters, towers on them, lower towers at the banks, floodlights at their feet.
void addTowers(Glb& glb, const Paints& paint) {
    const TowerPaints walls{paint.stone, paint.trim, paint.roof, paint.gilt, paint.glass, paint.window};
    Model floods{"floodlights", {}}, beads{"tower_lamps", {}};
    for (float side : {-1.0f, 1.0f}) {
        const std::string name = side < 0 ? "west" : "east";
        const glm::vec3 foot(side * towerX, road, 0);
        glb.addNode(
            gothicTower("tower_" + name, walls, {.size = towerSize, .turret = 1.85f, .roofHeight = 14, .passage = 8, .storeys = 3, .seed = side < 0 ? 5u : 9u}),
            {.translation = foot});
        Model pier{"pier_" + name, {}};
        Mesh block = bent(inBlocks(roundedBox({19, 13, 38}, 0.6f, 2, Axis::x, 10)), [](const glm::vec3& p) {
            const float t = glm::smoothstep(9.0f, 19.0f, std::abs(p.z));
            return glm::vec3(p.x * (1 - 0.85f * t) * (p.y > 0 ? 1.0f : 1.03f), p.y, p.z);
        });
        pier.add(paint.granite, placed(block, {foot.x, road - 7.2f, 0}));
        pier.add(paint.trim, placed(inBlocks(roundedBox({17.4f, 0.8f, 19}, 0.3f, 2)), {foot.x, road - 0.35f, 0}));
        glb.addNode(pier);
        // Behind a low kerb on the pier, facing up the walls.
        for (float z : {-1.0f, 1.0f})
            for (float x : {-4.5f, 0.0f, 4.5f}) {
                const glm::vec3 at(foot.x + x, road + 0.4f, z * (towerSize.z / 2 + 3.2f));
                floods.add(paint.flood, panel(at, {0, 1, -0.38f * z}, {1.1f, 0.55f}));
                floods.add(paint.iron, placed(roundedBox({1.3f, 0.5f, 0.15f}, 0.04f, 1), at + glm::vec3(0, 0, 0.45f * z)));
            }
        for (float x : {-1.0f, 1.0f})
            for (int i = -2; i <= 2; ++i) {
                const glm::vec3 at(foot.x + x * (towerSize.x / 2 + 1.6f), walkway + 5.0f, 1.3f * float(i));
                floods.add(paint.flood, panel(at, {-0.5f * x, 1, 0}, {0.3f, 0.5f}));
            }
        // Beads of light along the parapet and up the spires.
        for (int i = 0; i < 10; ++i) {
            const float t = (float(i) + 0.5f) / 10 - 0.5f;
            for (float z : {-1.0f, 1.0f})
                beads.add(paint.bead, bulb(foot + glm::vec3(t * towerSize.x, towerSize.y + 1.9f, z * (towerSize.z / 2 + 0.35f)), 0.14f));
            for (float x : {-1.0f, 1.0f})
                beads.add(paint.bead, bulb(foot + glm::vec3(x * (towerSize.x / 2 + 0.35f), towerSize.y + 1.9f, t * towerSize.z), 0.14f));
        }
        beads.add(paint.red, bulb(foot + glm::vec3(0, towerSize.y + 20, 0), 0.3f));

        glb.addNode(gothicTower("abutment_" + name, walls,
                                {.size = {8, 19, 15}, .turret = 1.3f, .roofHeight = 7, .passage = 8, .storeys = 1, .seed = side < 0 ? 3u : 4u}),
                    {.translation = {side * abutmentX, road, 0}});
        Model shore{"shore_" + name, {}};
        shore.add(paint.granite, placed(inBlocks(roundedBox({14, 13, 22}, 0.4f, 2)), {side * abutmentX, road - 6.9f, 0}));
        glb.addNode(shore);
    }
    glb.addNode(floods);
    glb.addNode(beads);
}

/// Road, side girders, walkways, chains and hangers; lamps along all of them.
void addSpans(Glb& glb, const Paints& paint) {
    Model deck{"deck", {}}, iron{"ironwork", {}}, beads{"chain_lamps", {}};
    deck.add(paint.asphalt, placed(roundedBox({2 * bank + 60, 0.8f, 2 * halfRoad}, 0.1f, 1), {0, road - 0.4f, 0}));
    for (float side : {-1.0f, 1.0f}) {
        const float z = side * (halfRoad + 0.1f);
        deck.add(paint.trim, placed(inBlocks(roundedBox({2 * bank + 60, 0.5f, 0.5f}, 0.1f, 1)), {0, road + 0.1f, z}));
        iron.add(paint.blue, girder({-bank, road + 0.3f, z}, {bank, road + 0.3f, z}, 1.5f, 96, 0.13f, 0.06f));
        // Between the towers the bascules: the lower chord rises towards the middle.
        std::vector<glm::vec3> upper, lower;
        for (int i = 0; i <= 22; ++i) {
            const float x = -24 + 48 * float(i) / 22, t = 1 - std::abs(x) / 24;
            upper.push_back({x, road - 0.5f, z});
            lower.push_back({x, road - 1.4f - 3.4f * (1 - std::pow(t, 0.7f)), z});
        }
        iron.add(paint.white, lattice(upper, lower, 0.22f, 0.10f));
        iron.add(paint.blue, girder({-towerX + 6, walkway, side * 4.6f}, {towerX - 6, walkway, side * 4.6f}, 3.6f, 22, 0.20f, 0.09f));
        deck.add(paint.white, placed(roundedBox({2 * towerX - 12, 0.35f, 0.5f}, 0.1f, 1), {0, walkway - 0.1f, side * 4.6f}));
        deck.add(paint.roof, placed(roundedBox({2 * towerX - 12, 0.3f, 3.4f}, 0.1f, 1), {0, walkway + 3.8f, side * 4.2f}));
        for (int i = 0; i < 26; ++i) {
            const float x = -24.6f + 49.2f * float(i) / 25;
            beads.add(paint.bead, bulb({x, walkway - 0.45f, side * 4.9f}, 0.13f));
            if (i % 2) beads.add(paint.window, placed(panel(glm::vec3(0), {0, 0, side}, {1.2f, 1.6f}), {x, walkway + 1.7f, side * 3.9f}));
        }
        for (float end : {-1.0f, 1.0f}) {
            // The chain hangs from the tower to a low point near the bank and rises again to the lower tower.
            std::vector<glm::vec3> high, low;
            constexpr int links = 22;
            for (int i = 0; i <= links; ++i) {
                const float t = float(i) / links, x = end * glm::mix(towerX + 6.0f, abutmentX - 3.6f, t);
                const float y = road + 3.4f + 27.5f * std::pow(1 - t / 0.78f, 2.0f) * (t < 0.78f ? 1.0f : 1.55f);
                high.push_back({x, y + 0.8f + 1.9f * std::sin(3.14159265f * t), z});
                low.push_back({x, y, z});
                if (i % 2 == 0 && i > 1 && i < links - 1) iron.add(paint.white, bar({x, road + 1.6f, z}, {x, y, z}, 0.07f, 5));
                beads.add(paint.bead, bulb(high.back() + glm::vec3(0, 0.35f, 0.15f * side), 0.12f));
            }
            iron.add(paint.blue, lattice(high, low, 0.26f, 0.10f));
        }
    }
    for (Model* part : {&deck, &iron, &beads}) glb.addNode(*part);

    const int lamp = glb.addMesh(streetLamp("road_lamp", paint.iron, paint.globe, 4.6f, false));
    int number = 0;
    for (int i = 0; i <= 28; ++i) {
        const float x = -bank + 2 + (2 * bank - 4) * float(i) / 28;
        if (std::abs(std::abs(x) - towerX) < 8 || std::abs(std::abs(x) - abutmentX) < 5) continue;
        for (float side : {-1.0f, 1.0f}) glb.addNode("road_lamp_" + std::to_string(number++), lamp, {.translation = {x, road, side * (halfRoad - 0.5f)}});
    }
}

/// Blocks of houses on both banks, each with some windows lit.
void addCity(Glb& glb, const Paints& paint) {
    Random random(12);
    Model houses{"city", {}}, windows{"city_windows", {}};
    const auto block = [&](const glm::vec3& at, const glm::vec3& size) {
        houses.add(paint.brick, placed(inBlocks(roundedBox(size, 0.2f, 1)), at + glm::vec3(0, size.y / 2, 0)));
        houses.add(paint.roof, placed(inBlocks(roundedBox({size.x * 0.5f, 3, size.z * 0.5f}, 0.1f, 1)), at + glm::vec3(0, size.y + 1, 0)));
        const int floors = int(size.y / 3.8f);
        // The faces towards the river and towards the camera's end.
        for (const auto& [facing, width, out] :
             {std::tuple{glm::vec3(at.x > 0 ? -1 : 1, 0, 0), size.z, size.x / 2}, std::tuple{glm::vec3(0, 0, 1), size.x, size.z / 2}})
            for (int floor = 0; floor < floors; ++floor)
                for (float along = -width / 2 + 1.8f; along < width / 2 - 1.5f; along += 3.0f) {
                    if (random.next() > 0.20f) continue;
                    const glm::vec3 across = glm::cross(glm::vec3(0, 1, 0), facing);
                    windows.add(paint.window,
                                panel(at + facing * (out + 0.05f) + across * along + glm::vec3(0, 2.4f + 3.8f * float(floor), 0), facing, {1.2f, 1.9f}));
                }
    };
    for (int row = 0; row < 3; ++row)
        for (float z = -250; z < 160; z += 15) {
            const float x = bank + 26 + 42 * float(row) + random.between(-4, 6);
            const glm::vec3 size(random.between(11, 19), random.between(11, 20) + 9 * float(row) + (random.next() < 0.10f ? 26.0f : 0.0f),
                                 random.between(10, 14.5f));
            block({x, 4, z + random.between(-2, 2)}, size);
            if (z < -22) block({-x - 6, 4, z}, {size.z, size.y * 0.8f, size.x * 0.8f});
        }
    glb.addNode(houses);
    glb.addNode(windows);

    Model shore{"banks", {}};
    for (float side : {-1.0f, 1.0f}) {
        shore.add(paint.granite, placed(inBlocks(roundedBox({300, 10, 640}, 0.3f, 1)), {side * (bank + 150), -0.4f, -60}));
        shore.add(paint.trim, placed(inBlocks(roundedBox({0.9f, 0.5f, 640}, 0.15f, 1)), {side * (bank + 0.2f), 4.75f, -60}));
    }
    // Far off the river bends away behind houses.
    shore.add(paint.brick, placed(inBlocks(roundedBox({2 * bank + 40, 12, 12}, 0.2f, 1)), {0, 4, -330}));
    glb.addNode(shore);
    const int lamp = glb.addMesh(streetLamp("quay_lamp", paint.iron, paint.globe, 4.4f, true));
    for (int i = 0; i < 19; ++i)
        for (float side : {-1.0f, 1.0f}) {
            const float z = 70.5f - 17 * float(i);
            if (std::abs(z) < 9) continue;
            glb.addNode("quay_lamp_" + std::string(side < 0 ? "w" : "e") + std::to_string(i), lamp,
                        {.translation = {side * (bank + 2.2f), 4.6f, z}, .rotation = turnY(90)});
        }
}

/// The camera's quay: wet setts and a railing; a boat with a lit cabin on the water.
void addQuay(Glb& glb, const Paints& paint) {
    Model quay{"quay", {}};
    Mesh ground = rectangle({-bank - 40, 4.62f, 12}, {40, 0, 0}, {0, 0, 110});
    scaleUv(ground, glm::vec2(40, 110) / settsSize);
    quay.add(paint.setts, ground);
    for (float z = 12; z < 112; z += 2.4f) {
        const glm::vec2 post[] = {{0, 1.28f}, {0.05f, 1.25f}, {0.075f, 1.18f}, {0.04f, 1.10f}, {0.05f, 0.6f}, {0.08f, 0.15f}, {0.11f, 0}};
        quay.add(paint.iron, placed(turned(post, 10), {-bank - 0.15f, 4.95f, z}));
    }
    for (float y : {5.35f, 5.72f, 6.08f}) quay.add(paint.iron, bar({-bank - 0.15f, y, 12}, {-bank - 0.15f, y, 112}, 0.032f, 8));
    glb.addNode(quay);

    Model boat{"boat", {}};
    Mesh hull = bent(roundedBox({5.0f, 2.4f, 24}, 0.5f, 2, Axis::z, 12), [](const glm::vec3& p) {
        const float bow = glm::smoothstep(3.0f, 12.0f, p.z);
        return glm::vec3(p.x * (1 - 0.92f * bow * bow) * (p.y < 0 ? 0.8f : 1.0f), p.y + 0.9f * bow * bow, p.z);
    });
    boat.add(paint.blue, placed(hull, {0, 0.7f, 0}));
    boat.add(paint.white, placed(roundedBox({3.8f, 1.9f, 13}, 0.2f, 2), {0, 2.8f, -2.5f}));
    boat.add(paint.white, placed(roundedBox({4.2f, 0.18f, 14}, 0.08f, 2), {0, 3.85f, -2.5f}));
    for (float side : {-1.0f, 1.0f})
        for (int i = 0; i < 8; ++i) boat.add(paint.window, panel({side * 1.93f, 2.9f, -7.8f + 1.5f * float(i)}, {side, 0, 0}, {1.05f, 0.85f}));
    addFestoon(boat, paint.iron, paint.bead, {{0, 3.9f, -9}, {0, 6.5f, -2}, 0.3f, 8, 0.09f});
    addFestoon(boat, paint.iron, paint.bead, {{0, 6.5f, -2}, {0, 3.4f, 11.5f}, 0.5f, 12, 0.09f});
    boat.add(paint.iron, bar({0, 3.8f, -2}, {0, 7.2f, -2}, 0.07f, 6));
    boat.add(paint.red, bulb({0, 7.3f, -2}, 0.16f));
    glb.addNode(boat, {.translation = {-67, 0, 26}, .rotation = turnY(-148)});
}

Glb makeBridge() {
    Glb glb;
    const Paints paint = addPaints(glb);
    addTowers(glb, paint);
    addSpans(glb, paint);
    addCity(glb, paint);
    addQuay(glb, paint);
    Model river{"river", {}};
    river.add(paint.water, waterSheet({-bank - 1, -120}, {bank + 1, 110}, 1.25f, {.length = 7, .height = 0.10f, .heading = 1.2f, .seed = 6}));
    river.add(paint.water, rectangle({-bank - 1, -0.12f, -330}, {2 * bank + 2, 0, 0}, {0, 0, 212}));
    glb.addNode(river);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeBridge)

}  // namespace lodestir::generate
