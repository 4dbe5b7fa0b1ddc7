// SPDX-License-Identifier: MIT
// A hall open to the sky between two storeys of arcades: bronze cats on plinths before its columns, banners in its arches, orange trees.
#include <string>
#include <vector>

#include "kit/arcade.h"
#include "kit/cat.h"
#include "kit/cloth.h"
#include "kit/marble.h"
#include "kit/masonry.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/slab.h"
#include "kit/tableware.h"
#include "kit/tree.h"

namespace lodestir::generate {

namespace {

constexpr int bays = 8;
constexpr float bay = 2.7f, length = bays * bay, halfWidth = 3.1f, aisle = 3.0f;
constexpr float columnHeight = 2.7f, columnRadius = 0.2f, gallery = 4.63f, roof = 6.6f;
constexpr float plinthHeight = 0.74f;

struct Paints {
    int stone, trim, column, floor, red, ochre, wood, gilt;
};

/// A side of the hall in its own frame: x along the row, the hall towards +z, the foot of its columns at z = 0.
Model side(const std::string& name, const Paints& paints) {
    Model model{name, {}};
    const auto box = [&](int material, float repeat, const glm::vec3& low, const glm::vec3& high, float bevel = 0) {
        model.add(material, slab(low, high, repeat, bevel));
    };
    const auto wall = [&](const ArchBay& arch, const glm::vec3& at) {
        model.add(paints.stone, placed(inTiles(archBay(arch), ashlarSize), at));
        model.add(paints.trim, placed(inTiles(archivolt(arch, 0.05f), ashlarSize), at));
    };
    const ArchBay lower{.width = bay, .height = 1.75f, .opening = bay - 0.5f, .spring = 0.1f, .afloat = true, .depth = 0.5f};
    const ArchBay upper{.width = bay / 2, .height = 1.8f, .opening = 0.82f, .sill = 0.6f, .spring = 1.08f, .depth = 0.36f};
    const float half = length / 2;
    for (int i = 0; i < bays; ++i) {
        const float x = (float(i) + 0.5f) * bay - half;
        wall(lower, {x, columnHeight, 0});
        for (float shift : {-0.25f, 0.25f}) {
            wall(upper, {x + shift * bay, gallery, 0});
            box(paints.trim, ashlarSize, {x + shift * bay - 0.5f, gallery + 0.52f, 0.1f}, {x + shift * bay + 0.5f, gallery + 0.6f, 0.28f}, 0.015f);
        }
        // Dentils below the cornice.
        for (int k = 0; k < 9; ++k) {
            const float d = x + (float(k) - 4) * bay / 9;
            box(paints.trim, ashlarSize, {d - 0.07f, roof - 0.32f, 0.15f}, {d + 0.07f, roof - 0.20f, 0.34f}, 0.01f);
        }
        box(paints.wood, 1.2f, {x - bay / 2 - 0.1f, 4.2f, -aisle}, {x - bay / 2 + 0.1f, 4.45f, -0.2f}, 0.01f);  // a beam of the aisle's ceiling
    }
    box(paints.trim, ashlarSize, {-half, 4.45f, -0.3f}, {half, 4.63f, 0.33f}, 0.04f);
    box(paints.trim, ashlarSize, {-half, 4.36f, -0.27f}, {half, 4.45f, 0.28f}, 0.02f);
    box(paints.trim, ashlarSize, {-half, roof - 0.2f, -0.3f}, {half, roof, 0.48f}, 0.04f);
    box(paints.wood, 1.2f, {-half, 4.44f, -aisle}, {half, 4.60f, -0.25f});
    box(paints.wood, 1.2f, {-half, roof - 0.2f, -aisle}, {half, roof, -0.2f});
    box(paints.red, plasterSize, {-half, 0.9f, -aisle - 0.3f}, {half, 4.45f, -aisle});
    box(paints.trim, ashlarSize, {-half, 0, -aisle - 0.3f}, {half, 0.9f, -aisle + 0.04f}, 0.02f);
    box(paints.ochre, plasterSize, {-half, 4.45f, -aisle - 0.3f}, {half, roof, -aisle});
    return model;
}

/// What closes an end, around z = 0: a wall with a tall gate to the garden.
Model gate(const Paints& paints) {
    Model model{"gate", {}};
    const ArchBay arch{.width = 2 * halfWidth, .height = roof, .opening = 2.5f, .spring = 3.2f, .depth = 0.6f};
    model.add(paints.stone, inTiles(archBay(arch), ashlarSize));
    model.add(paints.trim, inTiles(archivolt(arch, 0.09f), ashlarSize));
    for (float side : {-1.0f, 1.0f})
        model.add(paints.stone, slab({side * (halfWidth + aisle / 2 + 0.15f) - aisle / 2 - 0.15f, 0, -0.3f},
                                     {side * (halfWidth + aisle / 2 + 0.15f) + aisle / 2 + 0.15f, roof, 0.3f}, ashlarSize));
    model.add(paints.trim, slab({-halfWidth, roof - 0.2f, -0.5f}, {halfWidth, roof, 0.5f}, ashlarSize, 0.04f));
    return model;
}

Model plinth(const Paints& paints) {
    Model model{"plinth", {}};
    const auto block = [&](float low, float high, float half) { model.add(paints.trim, slab({-half, low, -half}, {half, high, half}, ashlarSize, 0.015f)); };
    block(0, 0.12f, 0.40f), block(0.12f, 0.17f, 0.36f), block(plinthHeight - 0.11f, plinthHeight, 0.39f);
    model.add(paints.column, slab({-0.31f, 0.17f, -0.31f}, {0.31f, plinthHeight - 0.11f, 0.31f}, slabSize, 0.01f));
    return model;
}

/// Stands each thing along both rows. `turn` is that of the row: its own +z looks into the hall.
template <class Put> void alongRows(const Put& put) {
    for (float side : {-1.0f, 1.0f})
        put(std::string(side < 0 ? "left" : "right"), side, turnY(side < 0 ? 90.0f : -90.0f), [side](float along, float inward) {
            return glm::vec3(side * (halfWidth - inward), 0, -along);  // `along`: metres from the near end
        });
}

void addGarden(Glb& glb, int leaf) {
    const int orchard = glb.addMesh("orchard", tree(5, {.height = 4.4f, .spread = 1.5f, .dabs = 4000, .dab = 0.15f}), leaf);
    const glm::vec2 places[] = {{-1.7f, 4}, {1.8f, 4.6f}, {-1.9f, 9}, {2.1f, 10}, {0.2f, 15}, {-4.8f, 13}, {4.9f, 14}, {-2.4f, 19}, {2.6f, 21}};
    for (int i = 0; i < int(std::size(places)); ++i)
        glb.addNode("orchard_" + std::to_string(i), orchard, {.translation = {places[i].x, 0, -length - places[i].y}, .rotation = turnY(73.0f * float(i))});
    Model lawn{"lawn", {}};
    lawn.add(glb.addMaterial({.name = "lawn", .color = {0.13f, 0.20f, 0.06f}, .ior = 1}),
             rectangle({-40, -0.02f, -length - 60}, {80, 0, 0}, {0, 0, length + 90}));
    glb.addNode(lawn);
}

Glb makeHallway() {
    Glb glb;
    const Textures ashlar = paintAshlar({0.68f, 0.585f, 0.45f}, 3, 768), weave = paintWeave(6, 384);
    const Paints paints{
        .stone = glb.addMaterial(glb.dressed({.name = "sandstone"}, ashlar)),
        .trim = glb.addMaterial({.name = "limestone", .color = {0.64f, 0.57f, 0.46f}, .roughness = 0.85f}),
        .column = glb.addMaterial(glb.dressed({.name = "marble"}, paintMarble({{0.66f, 0.60f, 0.53f}, {0.40f, 0.26f, 0.20f}, 0.22f}, 8, 512))),
        .floor = glb.addMaterial(glb.dressed({.name = "floor"}, paintMarbleFloor({{0.60f, 0.54f, 0.46f}, {0.36f, 0.28f, 0.22f}, 0.22f},
                                                                                 {{0.20f, 0.075f, 0.05f}, {0.5f, 0.36f, 0.28f}, 0.2f}, 5, 768))),
        .red = glb.addMaterial(glb.dressed({.name = "red_plaster"}, paintPlaster({0.50f, 0.17f, 0.10f}, 4, 512))),
        .ochre = glb.addMaterial(glb.dressed({.name = "ochre_plaster"}, paintPlaster({0.62f, 0.44f, 0.22f}, 9, 256))),
        .wood = glb.addMaterial({.name = "beams", .color = {0.16f, 0.095f, 0.05f}, .roughness = 0.8f}),
        .gilt = glb.addMaterial({.name = "gilt", .color = {0.9f, 0.62f, 0.26f}, .roughness = 0.3f, .metalness = 1})};
    const int clay = glb.addMaterial({.name = "clay", .color = {0.50f, 0.22f, 0.12f}, .roughness = 0.7f}),
              soil = glb.addMaterial({.name = "soil", .color = {0.05f, 0.035f, 0.025f}}), leaf = glb.addMaterial(dabs());

    Mesh shaft = inTiles(column(columnHeight, columnRadius), slabSize);
    computeTangents(shaft);
    const int columns = glb.addMesh("column", shaft, paints.column), row = glb.addMesh(side("arcade", paints)), stand = glb.addMesh(plinth(paints)),
              bronze = glb.addMesh(cat(glb, "cat", 0.0052f)), orangePot = glb.addMesh(pot("pot", clay, soil, 0.5f));
    const int orange = glb.addMesh("orange",
                                   tree(9, {.height = 1.7f,
                                            .spread = 0.55f,
                                            .waist = 0.55f,
                                            .bare = 0.36f,
                                            .dabs = 1400,
                                            .dab = 0.085f,
                                            .shade = {0.02f, 0.06f, 0.02f},
                                            .light = {0.10f, 0.22f, 0.045f},
                                            .accent = {0.85f, 0.35f, 0.03f}}),
                                   leaf);
    const glm::vec3 dyes[] = {{0.42f, 0.025f, 0.03f}, {0.03f, 0.07f, 0.30f}, {0.55f, 0.33f, 0.05f}, {0.03f, 0.20f, 0.10f}};
    std::vector<int> banners;
    for (int i = 0; i < int(std::size(dyes)); ++i) {
        const std::string name = "banner_cloth_" + std::to_string(i);
        Model cloth{name, {}};
        cloth.add(glb.addMaterial(glb.dressed({.name = name, .color = dyes[i], .doubleSided = true}, weave)),
                  inTiles(curtain(40 + uint32_t(i), 0.85f, 2.0f), weaveSize));
        cloth.add(paints.gilt, bar({-0.52f, 0.02f, 0}, {0.52f, 0.02f, 0}, 0.025f, 12));
        banners.push_back(glb.addMesh(cloth));
    }

    alongRows([&](const std::string& name, float side, const glm::quat& turn, const auto& at) {
        glb.addNode("arcade_" + name, row, {.translation = at(length / 2, 0), .rotation = turn});
        for (int i = 0; i <= bays; ++i) glb.addNode("column_" + name + "_" + std::to_string(i), columns, {.translation = at(float(i) * bay, 0)});
        for (int i = 1; i < bays; ++i) {
            const std::string number = "_" + name + "_" + std::to_string(i);
            const glm::vec3 place = at(float(i) * bay, 0.68f);
            glb.addNode("plinth" + number, stand, {.translation = place});
            // They look across the hall and a little towards who comes.
            glb.addNode("cat" + number, bronze,
                        {.translation = place + glm::vec3(0, plinthHeight, 0), .rotation = turnY(side < 0 ? -42.0f : 222.0f), .scale = glm::vec3(1.25f)});
        }
        for (int i = 0; i < bays; ++i) {
            const std::string number = "_" + name + "_" + std::to_string(i);
            const glm::vec3 middle = at((float(i) + 0.5f) * bay, 0);
            glb.addNode("banner" + number, banners[size_t(i + (side < 0 ? 0 : 1)) % banners.size()],
                        {.translation = middle + glm::vec3(0, 4.28f, 0) - side * glm::vec3(0.36f, 0, 0), .rotation = turn});
            glb.addNode("pot" + number, orangePot, {.translation = middle});
            glb.addNode("orange" + number, orange, {.translation = middle + glm::vec3(0, 0.42f, 0), .rotation = turnY(61.0f * float(i))});
        }
    });
    const int end = glb.addMesh(gate(paints));
    glb.addNode("gate_near", end, {.translation = {0, 0, 0.3f}}), glb.addNode("gate_far", end, {.translation = {0, 0, -length - 0.3f}});

    Model floor{"floor", {}};
    const glm::vec2 extent(2 * (halfWidth + aisle), length + 0.6f);
    Mesh tiles = rectangle({-extent.x / 2, 0, -length - 0.3f}, {extent.x, 0, 0}, {0, 0, extent.y});
    scaleUv(tiles, extent / marbleFloorSize);
    floor.add(paints.floor, tiles);
    glb.addNode(floor);
    addGarden(glb, leaf);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeHallway, "--levels 4 --ratio 4 --mesh cat")

}  // namespace lodestir::generate
