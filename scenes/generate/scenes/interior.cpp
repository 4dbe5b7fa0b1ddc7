// SPDX-License-Identifier: MIT
// A dining room on a summer afternoon: sun through a window and a garden door on herringbone oak, a table, books, an armchair, a plant.
#include <glm/gtc/matrix_transform.hpp>

#include "kit/bookcase.h"
#include "kit/cloth.h"
#include "kit/foliage.h"
#include "kit/furniture.h"
#include "kit/masonry.h"
#include "kit/painting.h"
#include "kit/random.h"
#include "kit/room.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/tableware.h"
#include "kit/wood.h"

namespace lodestir::generate {

namespace {

Palette addPalette(Glb& glb, const glm::vec2& rugSize) {
    const auto tinted = [&](Material material, const std::string& name, const glm::vec3& color) {
        material.name = name;
        material.color = color;
        return glb.addMaterial(material);
    };
    const Material plaster = glb.dressed({.name = "plaster"}, paintPlaster(glm::vec3(0.92f), 1, 512));
    Material weave = glb.dressed({.name = "weave"}, paintWeave(2, 512));
    const Material earthenware = glb.dressed({.name = "earthenware"}, paintEarthenware(glm::vec3(0.95f), 4, 512));

    Palette p{};
    p.oak = glb.addMaterial(glb.dressed({.name = "oak"}, paintPanel(oak(), 21, 1024)));
    p.walnut = glb.addMaterial(glb.dressed({.name = "walnut"}, paintPanel(walnut(), 22, 1024)));
    p.birch = glb.addMaterial({.name = "pale_frame", .color = {0.55f, 0.42f, 0.26f}, .roughness = 0.5f});
    p.floor = glb.addMaterial(glb.dressed({.name = "herringbone"}, paintHerringbone(oak(), 23, 1280)));

    p.wall = tinted(plaster, "wall", {0.82f, 0.78f, 0.71f});
    p.accent = tinted(plaster, "wall_sage", {0.25f, 0.31f, 0.25f});
    p.ceiling = tinted(plaster, "ceiling", {0.90f, 0.89f, 0.86f});
    p.trim = glb.addMaterial({.name = "trim", .color = {0.78f, 0.765f, 0.73f}, .roughness = 0.38f});

    p.upholstery = tinted(weave, "upholstery", {0.60f, 0.23f, 0.085f});
    p.cushion = tinted(weave, "cushion", {0.68f, 0.63f, 0.53f});
    p.books = tinted(weave, "book_cloth", glm::vec3(1));
    weave.doubleSided = true;
    p.linen = tinted(weave, "linen", {0.80f, 0.77f, 0.70f});
    // The lamp is lit: its cloth glows as a whole, which renderers sample far better than a bulb behind it.
    weave.emission = {0.50f, 0.31f, 0.15f};
    p.shade = tinted(weave, "lampshade", {0.82f, 0.76f, 0.64f});
    p.rug = glb.addMaterial(glb.dressed({.name = "rug"}, paintRug(5, 1024, rugSize)));

    p.paper = glb.addMaterial({.name = "paper", .color = {0.74f, 0.69f, 0.58f}, .roughness = 0.9f});
    p.gilt = glb.addMaterial({.name = "gilt", .color = {0.90f, 0.68f, 0.32f}, .roughness = 0.35f, .metalness = 1});
    p.blackMetal = glb.addMaterial({.name = "black_metal", .color = glm::vec3(0.018f), .roughness = 0.42f});
    p.brass = glb.addMaterial({.name = "brass", .color = {0.83f, 0.62f, 0.30f}, .roughness = 0.24f, .metalness = 1});
    p.enamel = glb.addMaterial({.name = "enamel", .color = glm::vec3(0.86f), .roughness = 0.25f});
    p.bulb = glb.addMaterial({.name = "bulb", .color = glm::vec3(0.88f), .roughness = 0.2f});

    p.stoneware = tinted(earthenware, "stoneware", {0.66f, 0.62f, 0.55f});
    p.clay = tinted(earthenware, "clay", {0.46f, 0.18f, 0.085f});
    p.glaze = tinted(earthenware, "glaze", {0.10f, 0.17f, 0.20f});
    p.fruit = glb.addMaterial({.name = "fruit", .roughness = 0.42f});
    p.leaf = glb.addMaterial(glb.dressed({.name = "leaf", .mask = true, .doubleSided = true}, paintLeaf(6, 256)));
    p.stem = glb.addMaterial({.name = "stem", .color = {0.13f, 0.10f, 0.05f}, .roughness = 0.7f});
    p.soil = glb.addMaterial({.name = "soil", .color = {0.035f, 0.024f, 0.016f}, .roughness = 1});
    p.grass = glb.addMaterial({.name = "garden", .roughness = 0.85f, .doubleSided = true});
    return p;
}

/// The table with what a late breakfast left on it, four chairs and the lamp above.
void addDining(Glb& glb, const Palette& palette, const Room& room, const glm::vec3& at) {
    constexpr float top = 0.74f;
    glb.addNode(diningTable(palette, {0.90f, 1.70f}), {.translation = at});

    const int seat = glb.addMesh(chair(palette));
    struct Seat {
        glm::vec2 offset;
        float turn;  ///< degrees; a chair faces -z before it is turned
    };
    const Seat seats[] = {{{-0.62f, -0.38f}, -90}, {{-0.60f, 0.40f}, -86}, {{0.63f, -0.40f}, 92}, {{0.80f, 0.46f}, 64}};
    int number = 0;
    for (const Seat& s : seats)
        glb.addNode("chair_" + std::to_string(number++), seat,
                    {.translation = at + glm::vec3(s.offset.x, 0, s.offset.y), .rotation = turnY(s.turn)});

    const float lampHeight = 1.62f;
    glb.addNode(pendantLamp(palette, room.height - 0.05f - lampHeight), {.translation = {at.x, room.height - 0.001f, at.z - 0.05f}});

    const glm::vec3 board = at + glm::vec3(0, top, 0);
    glb.addNode(bowl("fruit_bowl", palette.glaze, 0.145f), {.translation = board + glm::vec3(0.03f, 0, 0.10f)});
    glb.addNode(fruit("fruit", palette.fruit, 8, 0.145f), {.translation = board + glm::vec3(0.03f, 0, 0.10f)});
    glb.addNode(vase("vase", palette.stoneware, 0.27f, 0.085f), {.translation = board + glm::vec3(-0.06f, 0, -0.36f)});
    glb.addNode(twigs("twigs", 12, 0.52f, 7, {palette.leaf, palette.stem}), {.translation = board + glm::vec3(-0.06f, 0.10f, -0.36f)});
    glb.addNode(mug("mug", palette.stoneware), {.translation = board + glm::vec3(0.27f, 0, 0.36f), .rotation = turnY(50)});

    Model papers{"table_books", {}};
    addBook(
        papers, palette, {{0.030f, 0.24f, 0.17f}, {0.05f, 0.11f, 0.20f}, false},
        glm::rotate(glm::rotate(glm::translate(glm::mat4(1), {-0.10f, 0.015f, 0.62f}), 0.5f, {0, 1, 0}), glm::radians(-90.0f), {0, 0, 1}));
    addBook(papers, palette, {{0.022f, 0.21f, 0.15f}, {0.46f, 0.24f, 0.045f}, false},
            glm::rotate(glm::rotate(glm::translate(glm::mat4(1), {-0.09f, 0.0415f, 0.605f}), 0.85f, {0, 1, 0}), glm::radians(-90.0f),
                        {0, 0, 1}));
    glb.addNode(papers, {.translation = board});
}

/// The reading corner: armchair, lamp, side table and rug.
void addReading(Glb& glb, const Palette& palette, const glm::vec2& rugSize) {
    glb.addNode(armchair(palette), {.translation = {1.78f, 0, -1.15f}, .rotation = turnY(-38)});
    glb.addNode(floorLamp(palette), {.translation = {2.36f, 0, -1.98f}, .rotation = turnY(20)});

    const glm::vec3 table(1.02f, 0.0155f, -0.58f);
    glb.addNode(sideTable(palette, 0.25f, 0.46f), {.translation = table});
    const glm::vec3 top = table + glm::vec3(0, 0.46f, 0);
    glb.addNode(mug("reading_mug", palette.clay), {.translation = top + glm::vec3(0.10f, 0, 0.06f), .rotation = turnY(200)});
    Model pile{"reading_books", {}};
    const glm::mat4 flat = glm::rotate(glm::mat4(1), glm::radians(-90.0f), {0, 0, 1});
    addBook(pile, palette, {{0.026f, 0.22f, 0.155f}, {0.40f, 0.13f, 0.07f}, true},
            glm::translate(glm::mat4(1), {-0.18f, 0.013f, 0.06f}) * flat);
    addBook(pile, palette, {{0.018f, 0.20f, 0.14f}, {0.62f, 0.57f, 0.48f}, false},
            glm::rotate(glm::translate(glm::mat4(1), {-0.165f, 0.0353f, 0.06f}), 0.2f, {0, 1, 0}) * flat);
    glb.addNode(pile, {.translation = top, .rotation = turnY(25)});

    Model carpet{"rug", {}};
    carpet.add(palette.rug, rug(3, rugSize));
    glb.addNode(carpet, {.translation = {1.12f, 0.0005f, -0.35f}, .rotation = turnY(-6)});
}

void addWallsAndPlants(Glb& glb, const Palette& palette, const Room& room) {
    glb.addNode(bookcase(palette, 14, 1.50f, 2.05f), {.translation = {0.72f, 0, room.back + 0.02f}});  // clear of the skirting board

    const auto art = [&](const std::string& name, const Textures& picture) {
        return glb.addMaterial(glb.dressed({.name = name}, picture));
    };
    glb.addNode(pictureFrame("print_1", palette, {0.50f, 0.66f}, 0.06f, palette.birch, art("art_print_1", paintPrint(41, 384, 512))),
                {.translation = {-1.38f, 1.62f, room.back}});
    glb.addNode(pictureFrame("print_2", palette, {0.50f, 0.66f}, 0.06f, palette.birch, art("art_print_2", paintPrint(47, 384, 512))),
                {.translation = {-0.72f, 1.62f, room.back}});
    glb.addNode(pictureFrame("hills", palette, {0.78f, 0.60f}, 0.05f, palette.blackMetal, art("art_hills", paintHills(43, 512, 384))),
                {.translation = {room.halfWidth, 1.60f, -0.75f}, .rotation = turnY(-90)});

    const PlantMaterials green{palette.leaf, palette.stem};
    const glm::vec3 corner(-2.08f, 0, room.back + 0.46f);
    glb.addNode(pot("plant_pot", palette.clay, palette.soil, 0.36f), {.translation = corner});
    glb.addNode(rubberFig("plant", 19, 1.30f, 64, green), {.translation = corner + glm::vec3(0, 0.30f, 0)});

    const glm::vec3 sill(-room.halfWidth - 0.04f, room.sill + 0.022f, room.windowFront - 0.32f);
    glb.addNode(pot("sill_pot", palette.stoneware, palette.soil, 0.13f), {.translation = sill});
    glb.addNode(rubberFig("sill_plant", 23, 0.30f, 22, green), {.translation = sill + glm::vec3(0, 0.11f, 0)});
}

Glb makeInterior() {
    Glb glb;
    const Room room;
    const glm::vec2 rugSize(2.3f, 1.6f);
    const Palette palette = addPalette(glb, rugSize);
    addRoom(glb, palette, room);
    addGarden(glb, palette, room);
    addDining(glb, palette, room, {-1.02f, 0, -0.42f});
    addReading(glb, palette, rugSize);
    addWallsAndPlants(glb, palette, room);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeInterior)

}  // namespace lodestir::generate
