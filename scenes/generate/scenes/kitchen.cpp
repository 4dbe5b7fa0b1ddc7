// SPDX-License-Identifier: MIT
// A kitchen seen from low above its floor: sun through the slits of a blind and three small openings, polished tiles, chrome. What light there is
// comes from few bright spots, so that resampling has few paths to choose from and many pixels copy the same one.
#include <glm/gtc/matrix_transform.hpp>

#include "kit/cloth.h"
#include "kit/foliage.h"
#include "kit/furniture.h"
#include "kit/kitchen.h"
#include "kit/masonry.h"
#include "kit/metals.h"
#include "kit/plumbing.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/slab.h"
#include "kit/tableware.h"
#include "kit/teapot.h"
#include "kit/tiles.h"
#include "kit/wood.h"

namespace lodestir::generate {

namespace {

constexpr float left = -2.1f, right = 2.1f, back = -2.6f, front = 2.8f, height = 2.55f, wall = 0.14f;  ///< of the room, metres
constexpr glm::vec2 windowLow(-0.55f, 1.08f), windowHigh(0.95f, 2.10f);                                ///< in the back wall: x, y
constexpr float openings[] = {-1.15f, -0.35f, 0.45f};                                                 ///< in the right wall: z of their middles
constexpr glm::vec2 opening{0.36f, 0.32f};                                                             ///< their size: z, y
constexpr float openingSill = 1.95f, counterTop = 0.90f;

const Tiling chess{.tile = {0.30f, 0.30f}, .count = {4, 4}, .color = {0.78f, 0.76f, 0.72f}, .second = {0.075f, 0.085f, 0.095f}, .grout = {0.22f, 0.21f, 0.20f},
                   .joint = 0.0022f, .edge = 0.004f, .roughness = 0.10f, .tone = 0.05f, .tilt = 0.0016f, .wave = 0.0001f, .veins = 0.25f};
const Tiling splash{.tile = {0.15f, 0.075f}, .count = {4, 8}, .bond = true, .color = {0.80f, 0.79f, 0.75f}, .second = {0.80f, 0.79f, 0.75f},
                    .grout = {0.50f, 0.49f, 0.46f}, .tone = 0.05f, .tilt = 0.004f};

struct Paints {
    KitchenPaints kitchen;
    Palette kit;
    int floor, splash, plaster, enamel, copper;
};

Paints addPaints(Glb& glb) {
    Paints p{};
    p.floor = glb.addMaterial(glb.dressed({.name = "floor_tiles"}, paintTiles(chess, 7, 768)));
    p.splash = glb.addMaterial(glb.dressed({.name = "wall_tiles"}, paintTiles(splash, 8, 512)));
    p.plaster = glb.addMaterial(glb.dressed({.name = "plaster"}, paintPlaster({0.87f, 0.85f, 0.80f}, 1, 512)));
    p.enamel = glb.addMaterial({.name = "enamel", .color = {0.85f, 0.84f, 0.81f}, .roughness = 0.1f});
    p.copper = glb.addMaterial({.name = "copper", .color = copper, .roughness = 0.14f, .metalness = 1});
    p.kitchen.front = glb.addMaterial({.name = "painted_front", .color = {0.40f, 0.50f, 0.45f}, .roughness = 0.3f});
    p.kitchen.carcass = glb.addMaterial({.name = "carcass", .color = glm::vec3(0.03f), .roughness = 0.7f});
    p.kitchen.counter = glb.addMaterial(glb.dressed({.name = "counter"}, paintPanel(oak(), 21, 512)));
    p.kitchen.chrome = glb.addMaterial({.name = "chrome", .color = chrome, .roughness = 0.05f, .metalness = 1});
    p.kitchen.steel = glb.addMaterial({.name = "steel", .color = steel, .roughness = 0.22f, .metalness = 1});
    p.kitchen.black = glb.addMaterial({.name = "black_glass", .color = glm::vec3(0.012f), .roughness = 0.06f});
    p.kitchen.leather = glb.addMaterial({.name = "leather", .color = {0.30f, 0.105f, 0.045f}, .roughness = 0.42f});
    p.kit.trim = glb.addMaterial({.name = "trim", .color = {0.80f, 0.78f, 0.74f}, .roughness = 0.32f});
    p.kit.walnut = glb.addMaterial(glb.dressed({.name = "walnut"}, paintPanel(walnut(), 22, 512)));
    p.kit.blackMetal = glb.addMaterial({.name = "lamp_shade", .color = {0.10f, 0.16f, 0.15f}, .roughness = 0.2f});
    p.kit.enamel = p.enamel;
    p.kit.brass = glb.addMaterial({.name = "brass", .color = {0.83f, 0.62f, 0.30f}, .roughness = 0.2f, .metalness = 1});
    p.kit.bulb = glb.addMaterial({.name = "bulb", .color = glm::vec3(0.85f), .roughness = 0.2f});
    const Material earthenware = glb.dressed({.name = "earthenware"}, paintEarthenware(glm::vec3(0.95f), 4, 256));
    const auto glazed = [&](const char* name, const glm::vec3& color) {
        Material material = earthenware;
        material.name = name;
        material.color = color;
        return glb.addMaterial(material);
    };
    p.kit.stoneware = glazed("stoneware", {0.72f, 0.68f, 0.60f});
    p.kit.glaze = glazed("glaze", {0.10f, 0.20f, 0.30f});
    p.kit.clay = glazed("clay", {0.60f, 0.26f, 0.13f});
    p.kit.fruit = glb.addMaterial({.name = "fruit", .roughness = 0.42f});
    p.kit.leaf = glb.addMaterial(glb.dressed({.name = "leaf", .mask = true, .doubleSided = true}, paintLeaf(6, 256)));
    p.kit.stem = glb.addMaterial({.name = "stem", .color = {0.13f, 0.10f, 0.05f}, .roughness = 0.7f});
    p.kit.soil = glb.addMaterial({.name = "soil", .color = {0.035f, 0.024f, 0.016f}, .roughness = 1});
    return p;
}

void addShell(Glb& glb, const Paints& p) {
    Model floor{"floor", {}};
    floor.add(p.floor, facing(slab({left - wall, -0.1f, back - wall}, {right + wall, 0, front + wall}, 1), chess.size()));
    glb.addNode(floor);

    Model walls{"walls", {}};
    const auto plain = [&](const glm::vec3& low, const glm::vec3& high) { walls.add(p.plaster, facing(slab(low, high, 1), glm::vec2(plasterSize))); };
    plain({left - wall, 0, back - wall}, {windowLow.x, height, back});
    plain({windowHigh.x, 0, back - wall}, {right + wall, height, back});
    plain({windowLow.x, 0, back - wall}, {windowHigh.x, windowLow.y, back});
    plain({windowLow.x, windowHigh.y, back - wall}, {windowHigh.x, height, back});
    plain({left - wall, 0, back}, {left, height, front});
    plain({left - wall, 0, front}, {right + wall, height, front + wall});
    plain({left - wall, height, back - wall}, {right + wall, height + 0.1f, front + wall});
    plain({right, 0, back}, {right + wall, openingSill, front});
    plain({right, openingSill + opening.y, back}, {right + wall, height, front});
    float z = back;
    for (float middle : openings) {
        plain({right, openingSill, z}, {right + wall, openingSill + opening.y, middle - opening.x / 2});
        z = middle + opening.x / 2;
    }
    plain({right, openingSill, z}, {right + wall, openingSill + opening.y, front});
    glb.addNode(walls);

    // Glazed bricks a hand's breadth up to the window's sill along the counters.
    Model bricks{"splashback", {}};
    const auto glaze = [&](const glm::vec3& low, const glm::vec3& high) { bricks.add(p.splash, facing(slab(low, high, 1), splash.size())); };
    glaze({left, counterTop, back}, {right, windowLow.y - 0.02f, back + 0.008f});
    glaze({left, windowLow.y - 0.02f, back}, {windowLow.x - 0.06f, 1.575f, back + 0.008f});
    glaze({windowHigh.x + 0.06f, windowLow.y - 0.02f, back}, {right, 1.575f, back + 0.008f});
    glaze({left, counterTop, back}, {left + 0.008f, 1.575f, 0.30f});
    glb.addNode(bricks);
}

/// The window with its blind, which leaves slits and a strip above the sill.
void addWindow(Glb& glb, const Paints& p) {
    Model window{"window", {}};
    const float z = back - 0.10f;
    const auto board = [&](const glm::vec3& low, const glm::vec3& high) { window.add(p.kit.trim, slab(low, high, 1, 0.006f)); };
    constexpr float frame = 0.05f;
    for (float x : {windowLow.x, (windowLow.x + windowHigh.x - frame) / 2, windowHigh.x - frame})
        board({x, windowLow.y, z - 0.03f}, {x + frame, windowHigh.y, z + 0.03f});
    for (float y : {windowLow.y, windowHigh.y - frame}) board({windowLow.x, y, z - 0.03f}, {windowHigh.x, y + frame, z + 0.03f});
    board({windowLow.x - 0.05f, windowLow.y - 0.022f, z}, {windowHigh.x + 0.05f, windowLow.y + 0.010f, back + 0.05f});
    for (float x : {windowLow.x - 0.065f, windowHigh.x - 0.005f}) board({x, windowLow.y, back - 0.01f}, {x + 0.07f, windowHigh.y + 0.065f, back + 0.018f});
    board({windowLow.x - 0.065f, windowHigh.y - 0.005f, back - 0.01f}, {windowHigh.x + 0.065f, windowHigh.y + 0.065f, back + 0.019f});
    glb.addNode(window);

    Model blind{"blind", {}};
    const float x = (windowLow.x + windowHigh.x) / 2, width = windowHigh.x - windowLow.x - 0.03f, hang = back - 0.035f;
    constexpr float pitch = 0.036f, tilt = 64;
    const Mesh slat = bent(roundedBox({width, 0.0016f, 0.040f}, 0.0008f, 1, Axis::x, 4),
                           [](const glm::vec3& q) { return q + glm::vec3(0, 0.004f - 10 * q.z * q.z, 0); });
    const float lowest = windowLow.y + 0.24f;
    for (float y = windowHigh.y - 0.07f; y > lowest; y -= pitch)
        blind.add(p.kit.trim, placed(slat, glm::rotate(glm::translate(glm::mat4(1), {x, y, hang}), glm::radians(tilt), {1, 0, 0})));
    blind.add(p.kit.trim, slab({x - width / 2, windowHigh.y - 0.045f, hang - 0.025f}, {x + width / 2, windowHigh.y - 0.004f, hang + 0.025f}, 1, 0.003f));
    blind.add(p.kit.trim, slab({x - width / 2, lowest - 0.022f, hang - 0.02f}, {x + width / 2, lowest - 0.004f, hang + 0.02f}, 1, 0.003f));
    for (float side : {-0.36f, 0.0f, 0.36f})
        blind.add(p.kit.trim, bar({x + side * width, lowest - 0.01f, hang}, {x + side * width, windowHigh.y - 0.02f, hang}, 0.0012f, 6));
    glb.addNode(blind);
}

void addCabinets(Glb& glb, const Paints& p) {
    struct Piece {
        const char* name;
        float width;
        Fronts fronts;
    };
    float x = left + 0.62f;
    for (const Piece& piece : {Piece{"cabinet_0", 0.85f, Fronts::doors}, Piece{"cabinet_sink", 0.95f, Fronts::doors},
                               Piece{"cabinet_1", 0.60f, Fronts::drawers}, Piece{"cabinet_2", right - left - 0.62f - 2.40f, Fronts::doors}}) {
        glb.addNode(baseCabinet(piece.name, p.kitchen, piece.width, piece.fronts), {.translation = {x, 0, back}});
        x += piece.width;
    }
    // Along the left wall, from the corner to the front.
    float z = back + 0.62f;
    for (const Piece& piece : {Piece{"cabinet_3", 0.60f, Fronts::drawers}, Piece{"oven", 0.60f, Fronts::oven}, Piece{"cabinet_4", 0.90f, Fronts::doors},
                               Piece{"cabinet_5", 0.55f, Fronts::drawers}}) {
        z += piece.width;
        glb.addNode(baseCabinet(piece.name, p.kitchen, piece.width, piece.fronts), {.translation = {left, 0, z}, .rotation = turnY(90)});
    }
    Model corner{"corner", {}};
    corner.add(p.kitchen.carcass, slab({left, 0, back}, {left + 0.62f, 0.86f, back + 0.62f}, 1));
    corner.add(p.kitchen.counter, slab({left, 0.86f, back}, {left + 0.62f, counterTop, back + 0.62f}, 0.9f, 0.004f));
    glb.addNode(corner);

    Model hob{"hob", {}};
    const float hobZ = back + 0.62f + 0.90f;
    hob.add(p.kitchen.black, slab({left + 0.06f, counterTop, hobZ - 0.28f}, {left + 0.56f, counterTop + 0.005f, hobZ + 0.28f}, 1, 0.002f));
    glb.addNode(hob);
    glb.addNode(saucepan("pan_0", p.kitchen, 0.10f), {.translation = {left + 0.20f, counterTop + 0.005f, hobZ - 0.13f}, .rotation = turnY(20)});
    glb.addNode(saucepan("pan_1", p.kitchen, 0.085f), {.translation = {left + 0.42f, counterTop + 0.005f, hobZ + 0.12f}, .rotation = turnY(70)});
    glb.addNode(teapot("kettle", p.copper, 0.21f), {.translation = {left + 0.34f, counterTop, back + 2.1f}, .rotation = turnY(-40)});
    glb.addNode(basin("sink", p.enamel, {0.56f, 0.16f, 0.42f}, 5), {.translation = {0.20f, counterTop - 0.02f, back + 0.33f}});
    glb.addNode(tap("sink_tap", p.kitchen.chrome, 0.38f, 0.20f), {.translation = {0.20f, counterTop, back + 0.07f}});
    glb.addNode(vase("bottle", p.kit.glaze, 0.27f, 0.05f), {.translation = {-0.86f, counterTop, back + 0.22f}});
    glb.addNode(pot("herb_pot", p.kit.clay, p.kit.soil, 0.14f), {.translation = {0.78f, counterTop, back + 0.20f}});
    glb.addNode(twigs("herb", 12, 0.26f, 9, {p.kit.leaf, p.kit.stem}), {.translation = {0.78f, counterTop + 0.11f, back + 0.20f}});
    glb.addNode(mug("mug", p.kit.stoneware), {.translation = {1.25f, counterTop, back + 0.25f}, .rotation = turnY(40)});
}

/// A counter to sit at, three stools before it and two lamps above.
void addIsland(Glb& glb, const Paints& p) {
    constexpr float x = 0.82f, z0 = -1.15f, length = 1.9f, width = 0.72f;
    Model island{"island", {}};
    island.add(p.kitchen.front, slab({x + 0.16f, 0.1f, z0 + 0.03f}, {x + width - 0.03f, 0.86f, z0 + length - 0.03f}, 1, 0.003f));
    island.add(p.kitchen.carcass, slab({x + 0.2f, 0, z0 + 0.07f}, {x + width - 0.07f, 0.1f, z0 + length - 0.07f}, 1));
    island.add(p.kitchen.counter, slab({x, 0.86f, z0}, {x + width, counterTop, z0 + length}, 0.9f, 0.006f));
    for (int i = 0; i < 4; ++i) {
        const float a = z0 + 0.05f + 0.45f * float(i);
        island.add(p.kitchen.front, slab({x + 0.148f, 0.12f, a}, {x + 0.165f, 0.84f, a + 0.03f}, 1, 0.003f));
    }
    for (float y : {0.12f, 0.81f}) island.add(p.kitchen.front, slab({x + 0.149f, y, z0 + 0.05f}, {x + 0.165f, y + 0.03f, z0 + length - 0.05f}, 1, 0.003f));
    glb.addNode(island);
    const int stool = glb.addMesh(barStool("stool", p.kitchen));
    for (int i = 0; i < 3; ++i)
        glb.addNode("stool_" + std::to_string(i), stool,
                    {.translation = {x - 0.34f - 0.06f * float(i % 2), 0, z0 + 0.35f + 0.60f * float(i)}, .rotation = turnY(40.0f * float(i))});
    const int lamp = glb.addMesh(pendantLamp(p.kit, 0.85f));
    for (float z : {z0 + 0.45f, z0 + 1.45f}) glb.addNode("lamp_" + std::to_string(z > 0), lamp, {.translation = {x + width / 2, height - 0.001f, z}});
    const glm::vec3 top(x + width / 2, counterTop, z0 + 1.25f);
    glb.addNode(bowl("fruit_bowl", p.kit.glaze, 0.15f), {.translation = top});
    glb.addNode(fruit("fruit", p.kit.fruit, 8, 0.15f), {.translation = top});
}

Glb makeKitchen() {
    Glb glb;
    const Paints p = addPaints(glb);
    addShell(glb, p);
    addWindow(glb, p);
    addCabinets(glb, p);
    addIsland(glb, p);
    glb.addNode(bin("bin", p.kitchen, 0.15f, 0.42f), {.translation = {left + 0.80f, 0, 0.62f}});
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeKitchen)

}  // namespace lodestir::generate
