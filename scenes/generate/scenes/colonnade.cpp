// SPDX-License-Identifier: MIT
// A cloister seen from its walk: columns close by, a court in the sun behind them. A step aside shows what the columns hid.
#include <cmath>
#include <string>

#include "kit/arcade.h"
#include "kit/grass.h"
#include "kit/marble.h"
#include "kit/masonry.h"
#include "kit/random.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/tableware.h"
#include "kit/tree.h"

namespace lodestir::generate {

namespace {

constexpr float bay = 1.35f, court = 9, columnHeight = 2.0f, columnRadius = 0.13f, plinth = 0.45f;
constexpr int bays = 13;

struct Stones {
    int wall, column, floor;
};

/// A row of bays on a low wall that faces +z at the foot of `at`; each column is a node of its own.
void addArcade(Glb& glb, const Stones& stone, const std::string& name, const glm::mat4& at, const Placement& row) {
    Model arches{name + "_arches", {}};
    const ArchBay arch{.width = bay, .height = 1.3f, .opening = bay - 2 * 0.17f, .spring = 0.12f, .afloat = true, .depth = 0.34f};
    for (int i = 0; i < bays; ++i) {
        const float x = (float(i) - 0.5f * float(bays - 1)) * bay;
        const auto put = [&](const Mesh& mesh, const glm::vec3& offset) { arches.add(stone.wall, placed(inTiles(mesh, ashlarSize), offset)); };
        put(archBay(arch), {x, plinth + columnHeight, 0});
        put(archivolt(arch, 0.035f), {x, plinth + columnHeight, 0});
        put(roundedBox({bay, plinth, 0.42f}, 0.02f, 2), {x, plinth / 2, 0});
        put(roundedBox({bay, 0.12f, 0.46f}, 0.03f, 2), {x, plinth + columnHeight + 1.33f, 0});
    }
    glb.addNode(arches, row);
    Mesh shaft = inTiles(lodestir::generate::column(columnHeight, columnRadius), slabSize);
    computeTangents(shaft);
    const int column = glb.addMesh(name + "_column", shaft, stone.column);
    for (int i = 0; i <= bays; ++i) {
        const glm::vec3 foot(at * glm::vec4((float(i) - 0.5f * float(bays)) * bay, plinth, 0, 1));
        glb.addNode(name + "_column_" + std::to_string(i), column, {.translation = foot});
    }
}

Glb makeColonnade() {
    Glb glb;
    const Stones stone{glb.addMaterial(glb.dressed({.name = "limestone"}, paintAshlar({0.70f, 0.60f, 0.46f}, 3, 640))),
                       glb.addMaterial(glb.dressed({.name = "marble"}, paintMarble({{0.78f, 0.74f, 0.68f}, {0.50f, 0.36f, 0.28f}, 0.2f}, 8, 512))),
                       glb.addMaterial(glb.dressed({.name = "floor"}, paintMarbleFloor(carrara(), {{0.20f, 0.075f, 0.05f}, {0.5f, 0.36f, 0.28f}}, 5, 768)))};
    addArcade(glb, stone, "near", glm::mat4(1), {});
    const Placement far{.translation = {0, 0, -court}};
    addArcade(glb, stone, "far", glm::mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -court, 1), far);

    // The walks' floors, and the walls behind the far one.
    const float wide = bay * bays;
    Model walks{"walks", {}};
    const auto floor = [&](float back, float front) {
        Mesh mesh = grid(1, 1, [&](float u, float v) { return glm::vec3((u - 0.5f) * (wide + 12), 0, glm::mix(back, front, v)); });
        scaleUv(mesh, glm::vec2(wide + 12, front - back) / marbleFloorSize);
        walks.add(stone.floor, mesh);
    };
    floor(0, 3.2f), floor(-court - 2.6f, -court);
    glb.addNode(walks);
    Model back{"back", {}};
    Mesh wall = rectangle({-0.5f * wide - 6, 4.2f, -court - 2.6f}, {wide + 12, 0, 0}, {0, -4.2f, 0});
    scaleUv(wall, glm::vec2(wide + 12, 4.2f) / plasterSize);
    back.add(glb.addMaterial(glb.dressed({.name = "plaster"}, paintPlaster({0.62f, 0.30f, 0.20f}, 4, 512))), wall);
    glb.addNode(back);

    // The court: lawn, a basin with an orange tree in a pot at each side, flowers.
    const int lawn = glb.addMaterial({.name = "lawn", .color = {0.16f, 0.26f, 0.07f}, .ior = 1}),
              water = glb.addMaterial({.name = "water", .color = {0.02f, 0.06f, 0.07f}, .roughness = 0.06f}),
              clay = glb.addMaterial({.name = "clay", .color = {0.55f, 0.24f, 0.13f}, .roughness = 0.7f}),
              soil = glb.addMaterial({.name = "soil", .color = {0.05f, 0.035f, 0.025f}});
    const int leaf = glb.addMaterial(dabs());
    Model ground{"lawn", {}};
    ground.add(lawn, grid(1, 1, [&](float u, float v) { return glm::vec3((u - 0.5f) * (wide + 12), 0.02f, -court * (1 - v)); }));
    glb.addNode(ground);
    Model basin{"basin", {}};
    const glm::vec2 profile[] = {{0.95f, 0.34f}, {1.05f, 0.42f}, {1.2f, 0.42f}, {1.24f, 0.36f}, {1.16f, 0.1f}, {1.24f, 0}};
    basin.add(stone.wall, inTiles(turned(profile, 48), 0.4f));
    basin.add(water, placed(turned(std::vector<glm::vec2>{{0, 0}, {1.0f, 0}}, 32), glm::vec3(0, 0.33f, 0)));
    const glm::vec2 stem[] = {{0.0f, 1.25f}, {0.42f, 1.30f}, {0.46f, 1.24f}, {0.12f, 1.08f}, {0.07f, 0.8f}, {0.14f, 0.4f}, {0.2f, 0.2f}};
    basin.add(stone.wall, inTiles(turned(stem, 32), 0.4f));
    glb.addNode(basin, {.translation = {0.6f, 0, -4.4f}});
    const TreeForm form{.height = 1.9f,
                        .spread = 0.8f,
                        .waist = 0.55f,
                        .bare = 0.36f,
                        .dabs = 900,
                        .dab = 0.10f,
                        .shade = {0.02f, 0.06f, 0.02f},
                        .light = {0.12f, 0.26f, 0.05f},
                        .accent = {0.85f, 0.35f, 0.03f}};
    const int orange = glb.addMesh("orange", tree(9, form), leaf);
    const glm::vec3 places[] = {{-2.0f, 0, -2.4f}, {2.9f, 0, -2.6f}, {-1.7f, 0, -6.6f}, {2.8f, 0, -6.8f}, {-4.6f, 0, -4.6f}, {5.2f, 0, -4.6f}};
    for (int i = 0; i < int(std::size(places)); ++i) {
        glb.addNode(pot("pot_" + std::to_string(i), clay, soil, 0.5f), {.translation = places[i]});
        glb.addNode("orange_" + std::to_string(i), orange, {.translation = places[i] + glm::vec3(0, 0.42f, 0), .rotation = turnY(60.0f * float(i))});
    }
    const int flowers = glb.addMesh("flowers", flowerPatch({"flowers", 12, {0.78f, 0.12f, 0.10f}, {0.88f, 0.80f, 0.70f}}, 40, 0.6f), leaf);
    Random random(3);
    for (int i = 0; i < 16; ++i) {
        const float turn = random.between(0, 360), x = random.between(-5.5f, 5.5f),
                    z = i % 2 == 0 ? random.between(-1.5f, -0.7f) : random.between(-8.3f, -7.6f);
        glb.addNode("flowers_" + std::to_string(i), flowers, {.translation = {x, 0, z}, .rotation = turnY(turn)});
    }
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeColonnade)

}  // namespace lodestir::generate
