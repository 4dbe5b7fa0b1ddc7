// SPDX-License-Identifier: MIT
// A hall of columns lit by one window at its far end. Low sun falls through it on a long basin and a polished floor, which throw it on vault and columns:
// nearly all light arrives from twenty metres away, over a glossy bounce.
#include <cmath>
#include <string>
#include <vector>

#include "kit/arcade.h"
#include "kit/cloth.h"
#include "kit/foliage.h"
#include "kit/marble.h"
#include "kit/masonry.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/tableware.h"
#include "kit/water.h"
#include "kit/wood.h"

namespace lodestir::generate {

namespace {

// The nave runs along z; aisles lie outside the columns.
constexpr float nave = 3.4f, aisle = 5.9f, back = -21, front = 9.9f;
constexpr float bayLength = 4.4f, spring = 4.35f, cornice = 6.1f;
constexpr int bays = 7;
constexpr float basin = 1.35f, basinBack = -17.6f, basinFront = 4.6f;

struct Stones {
    int limestone, column, floor, rim, vault, water, wood, iron;
};

Stones addStones(Glb& glb) {
    Stones s{};
    s.limestone = glb.addMaterial(glb.dressed({.name = "limestone"}, paintAshlar({0.70f, 0.62f, 0.49f}, 3, 640)));
    s.column = glb.addMaterial(glb.dressed({.name = "column"}, paintMarble({{0.58f, 0.38f, 0.28f}, {0.76f, 0.66f, 0.56f}, 0.24f}, 8, 512)));
    s.floor = glb.addMaterial(glb.dressed({.name = "marble_floor"}, paintMarbleFloor(carrara(), {{0.075f, 0.070f, 0.072f}, {0.34f, 0.31f, 0.28f}}, 5, 896)));
    s.rim = glb.addMaterial(glb.dressed({.name = "rim"}, paintMarble(verde(), 9, 512)));
    s.vault = glb.addMaterial(glb.dressed({.name = "vault"}, paintPlaster({0.80f, 0.75f, 0.66f}, 4, 512)));
    // Still water over dark tiles: only what its surface reflects is to be seen.
    s.water = glb.addMaterial({.name = "water", .color = {0.006f, 0.022f, 0.024f}, .roughness = 0.055f, .ior = 1.333f});
    s.wood = glb.addMaterial(glb.dressed({.name = "walnut"}, paintPanel(walnut(), 6, 512)));
    s.iron = glb.addMaterial({.name = "iron", .color = glm::vec3(0.03f), .roughness = 0.5f, .metalness = 1});
    return s;
}

Mesh flat(const glm::vec3& corner, const glm::vec3& right, const glm::vec3& down, float repeat) {
    Mesh mesh = rectangle(corner, right, down);
    scaleUv(mesh, glm::vec2(glm::length(right), glm::length(down)) / repeat);
    return mesh;
}

void addShell(Glb& glb, const Stones& stone) {
    Model shell{"shell", {}};
    const float length = front - back;
    // The floor leaves the basin free.
    shell.add(stone.floor, flat({-aisle, 0, back}, {aisle - basin, 0, 0}, {0, 0, length}, marbleFloorSize));
    shell.add(stone.floor, flat({basin, 0, back}, {aisle - basin, 0, 0}, {0, 0, length}, marbleFloorSize));
    shell.add(stone.floor, flat({-basin, 0, back}, {2 * basin, 0, 0}, {0, 0, basinBack - back}, marbleFloorSize));
    shell.add(stone.floor, flat({-basin, 0, basinFront}, {2 * basin, 0, 0}, {0, 0, front - basinFront}, marbleFloorSize));
    for (float side : {-1.0f, 1.0f}) {
        const glm::vec3 turn = side * glm::vec3(0, 0, 1);
        shell.add(stone.limestone, flat({side * aisle, cornice, side < 0 ? front : back}, turn * length, {0, -cornice, 0}, ashlarSize));
        shell.add(stone.vault, flat({side < 0 ? -aisle : nave, cornice - 0.02f, front}, {aisle - nave, 0, 0}, {0, 0, -length}, plasterSize));
        // The wall of the nave above the arcade, and a cornice along the foot of the vault.
        shell.add(stone.limestone,
                  placed(inTiles(roundedBox({0.5f, 0.34f, length}, 0.12f, 3), ashlarSize), {side * (nave + 0.02f), cornice + 0.06f, (front + back) / 2}));
    }
    shell.add(stone.vault, placed(inTiles(barrelVault(nave, back, front, 48), plasterSize), {0, cornice, 0}));
    shell.add(stone.limestone, flat({aisle, 9.6f, front}, {-2 * aisle, 0, 0}, {0, -9.6f, 0}, ashlarSize));
    glb.addNode(shell);

    const ArchBay bay{
        .width = bayLength, .height = cornice, .opening = bayLength - 1.0f, .sill = spring - 0.02f, .spring = spring, .afloat = true, .depth = 0.62f};
    Model span{"arch", {}};
    span.add(stone.limestone, inTiles(archBay(bay), ashlarSize));
    span.add(stone.column, inTiles(archivolt(bay, 0.055f), slabSize));
    const int archMesh = glb.addMesh(span);
    Model shaft{"column", {}};
    shaft.add(stone.column, inTiles(column(spring, 0.37f), slabSize));
    const int columnMesh = glb.addMesh(shaft);
    Model rib{"rib", {}};
    std::vector<Station> hoop;
    for (int i = 0; i <= 32; ++i)
        hoop.push_back({{-nave * std::cos(3.14159265f * float(i) / 32), cornice + nave * std::sin(3.14159265f * float(i) / 32), 0}, 0.13f});
    rib.add(stone.limestone, inTiles(tube(hoop, 10), ashlarSize));
    const int ribMesh = glb.addMesh(rib);
    for (int i = 0; i <= bays; ++i) {
        const float z = back + bayLength * float(i);
        glb.addNode("rib_" + std::to_string(i), ribMesh, {.translation = {0, 0, z}});
        for (float side : {-1.0f, 1.0f}) {
            const std::string name = (side < 0 ? "left_" : "right_") + std::to_string(i);
            glb.addNode("column_" + name, columnMesh, {.translation = {side * nave, 0, z}});
            if (i < bays) glb.addNode("arch_" + name, archMesh, {.translation = {side * nave, 0, z + bayLength / 2}, .rotation = turnY(-90 * side)});
        }
    }
}

/// The far wall: one tall window of four lights under a rose, and iron bars.
void addWindow(Glb& glb, const Stones& stone) {
    const ArchBay opening{.width = 2 * aisle, .height = 9.6f, .opening = 5.6f, .sill = 0.95f, .spring = 5.7f, .depth = 0.7f};
    Model wall{"window_wall", {}};
    wall.add(stone.limestone, placed(inTiles(archBay(opening), ashlarSize), {0, 0, back}));
    wall.add(stone.column, placed(inTiles(archivolt(opening, 0.10f), slabSize), {0, 0, back}));
    const auto stoneBar = [&](const glm::vec3& from, const glm::vec3& to, float radius) { wall.add(stone.limestone, bar(from, to, radius, 10)); };
    const float z = back, r = opening.opening / 2;
    for (float x : {-0.5f, 0.0f, 0.5f}) stoneBar({x * r, opening.sill, z}, {x * r, opening.spring + (x == 0 ? 0.0f : 0.35f), z}, 0.075f);
    const auto hoop = [&](const glm::vec2& centre, float radius, float from, float to, float thick) {
        std::vector<Station> stations;
        for (int i = 0; i <= 20; ++i) {
            const float a = glm::mix(from, to, float(i) / 20);
            stations.push_back({{centre.x + radius * std::cos(a), centre.y + radius * std::sin(a), z}, thick});
        }
        wall.add(stone.limestone, tube(stations, 8));
    };
    constexpr float pi = 3.14159265f;
    for (int i = 0; i < 4; ++i) hoop({(-0.75f + 0.5f * float(i)) * r, opening.spring - 0.2f}, 0.25f * r, 0, pi, 0.06f);
    for (float x : {-0.5f, 0.5f}) hoop({x * r, opening.spring + 0.22f}, 0.5f * r, 0, pi, 0.07f);
    hoop({0, opening.spring + 1.50f}, 0.62f, 0, 2 * pi, 0.07f);
    for (int i = 0; i < 6; ++i)
        hoop(glm::vec2(0, opening.spring + 1.50f) + 0.31f * glm::vec2(std::cos(pi / 3 * float(i)), std::sin(pi / 3 * float(i))), 0.27f, 0, 2 * pi, 0.032f);
    for (float y : {2.1f, 3.1f, 4.1f, 5.1f}) wall.add(stone.iron, bar({-r, y, z}, {r, y, z}, 0.018f, 6));
    for (int i = 0; i < 8; ++i)
        wall.add(stone.iron, bar({(-0.875f + 0.25f * float(i)) * r, opening.sill, z}, {(-0.875f + 0.25f * float(i)) * r, opening.spring, z}, 0.012f, 6));
    glb.addNode(wall);
}

void addBasin(Glb& glb, const Stones& stone) {
    Model pool{"basin", {}};
    const float level = -0.06f, length = basinFront - basinBack;
    pool.add(stone.water, placed(waterSheet({-basin, basinBack}, {basin, basinFront}, 0.085f, {.length = 0.95f, .height = 0.006f, .heading = 1.3f, .seed = 4}),
                                 {0, level, 0}));
    for (float side : {-1.0f, 1.0f}) {
        pool.add(stone.rim, placed(inTiles(roundedBox({0.34f, 0.30f, length + 0.6f}, 0.03f, 3, Axis::z), slabSize),
                                   {side * (basin + 0.13f), -0.03f, (basinFront + basinBack) / 2}));
        pool.add(stone.rim,
                 placed(inTiles(roundedBox({2 * basin, 0.30f, 0.34f}, 0.03f, 3), slabSize), {0, -0.031f, side < 0 ? basinBack - 0.13f : basinFront + 0.13f}));
    }
    glb.addNode(pool);
}

/// Figs in pots along the basin, cloths between the columns, benches at the walls, a door behind.
void addFurnishing(Glb& glb, const Stones& stone) {
    const auto cloth = [&](const std::string& name, const glm::vec3& color, const Material& woven) {
        Material dyed = woven;
        dyed.name = name, dyed.color = color, dyed.doubleSided = true;
        return glb.addMaterial(dyed);
    };
    const Material weave = glb.dressed({.name = "weave"}, paintWeave(7, 256));
    const int dyes[] = {cloth("madder", {0.50f, 0.055f, 0.035f}, weave), cloth("indigo", {0.035f, 0.075f, 0.26f}, weave),
                        cloth("weld", {0.62f, 0.36f, 0.05f}, weave)};
    std::vector<int> banners;
    for (int i = 0; i < 3; ++i) {
        Model banner{"banner", {}};
        Mesh drape = curtain(uint32_t(20 + i), 1.5f, 2.9f);
        scaleUv(drape, glm::vec2(1 / weaveSize));
        banner.add(dyes[i], drape);
        banner.add(stone.wood, bar({-0.9f, 0.03f, 0}, {0.9f, 0.03f, 0}, 0.03f, 10));
        banners.push_back(glb.addMesh(banner));
    }
    const int clay = glb.addMaterial(glb.dressed({.name = "clay"}, paintEarthenware({0.46f, 0.19f, 0.09f}, 12, 256)));
    const int soil = glb.addMaterial({.name = "soil", .color = {0.035f, 0.024f, 0.016f}});
    const int leaf = glb.addMaterial(glb.dressed({.name = "leaf", .mask = true, .doubleSided = true}, paintLeaf(6, 256)));
    const int stem = glb.addMaterial({.name = "stem", .color = {0.13f, 0.10f, 0.05f}, .roughness = 0.7f});
    const int potMesh = glb.addMesh(pot("pot", clay, soil, 0.62f));
    const int figs[] = {glb.addMesh(rubberFig("fig", 31, 1.5f, 60, {leaf, stem})), glb.addMesh(rubberFig("fig_tall", 37, 1.9f, 72, {leaf, stem}))};
    Model bench{"bench", {}};
    bench.add(stone.rim, placed(inTiles(roundedBox({0.48f, 0.09f, 1.9f}, 0.02f, 2, Axis::z), slabSize), {0, 0.45f, 0}));
    for (float z : {-0.65f, 0.65f}) bench.add(stone.limestone, placed(inTiles(roundedBox({0.36f, 0.41f, 0.16f}, 0.03f, 2), ashlarSize), {0, 0.2f, z}));
    const int benchMesh = glb.addMesh(bench);
    for (int i = 0; i < bays; ++i) {
        const float z = back + bayLength * (float(i) + 0.5f);
        for (float side : {-1.0f, 1.0f}) {
            const std::string name = (side < 0 ? "left_" : "right_") + std::to_string(i);
            glb.addNode("banner_" + name, banners[size_t(i + (side > 0 ? 1 : 0)) % 3],
                        {.translation = {side * (aisle - 0.14f), 4.6f, z}, .rotation = turnY(-90 * side)});
            glb.addNode("bench_" + name, benchMesh, {.translation = {side * (aisle - 0.35f), 0, z}});
            const glm::vec3 foot(side * (basin + 0.95f), 0, z + 0.5f);
            if (z < basinBack || z > basinFront + 1) continue;
            glb.addNode("pot_" + name, potMesh, {.translation = foot});
            glb.addNode("fig_" + name, figs[(i + (side > 0 ? 1 : 0)) % 2],
                        {.translation = foot + glm::vec3(0, 0.52f, 0), .rotation = turnY(77.0f * float(i) + 40 * side)});
        }
    }
    Model door{"door", {}};
    door.add(stone.wood, placed(roundedBox({2.2f, 3.4f, 0.1f}, 0.02f), {0, 1.7f, front - 0.04f}));
    glb.addNode(door);
}

Glb makeFarWindow() {
    Glb glb;
    const Stones stone = addStones(glb);
    addShell(glb, stone);
    addWindow(glb, stone);
    addBasin(glb, stone);
    addFurnishing(glb, stone);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeFarWindow)

}  // namespace lodestir::generate
