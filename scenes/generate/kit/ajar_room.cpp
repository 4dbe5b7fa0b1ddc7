// SPDX-License-Identifier: MIT
// See ajar_room.h. The camera's room is in front of z = 0, the lit one behind.
#include "ajar_room.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

#include "furniture.h"
#include "joinery.h"
#include "masonry.h"
#include "metals.h"
#include "painting.h"
#include "shapes.h"
#include "slab.h"
#include "still_life.h"
#include "teapot.h"
#include "wood.h"

namespace lodestir::generate {

namespace {

constexpr float left = -1.95f, right = 1.65f, front = 3.1f, back = -2.6f, height = 2.6f;  ///< of both rooms, metres
constexpr float wall = 0.16f;                                                            ///< thickness
constexpr float doorLeft = -1.58f, doorRight = -0.64f, doorHead = 2.08f;
constexpr float ajar = 54;  ///< degrees, into the camera's room: what comes through the gap falls on the table

void addShell(Glb& glb, const Palette& p) {
    Model floor{"floor", {}};
    Mesh boards = slab({left - wall, -0.1f, back - wall}, {right + wall, 0, front + wall}, herringboneSize);
    floor.add(p.floor, boards);
    glb.addNode(floor);

    Model dark{"walls", {}};
    dark.add(p.wall, slab({left - wall, 0, 0}, {left, height, front + wall}, plasterSize));
    dark.add(p.wall, slab({right, 0, 0}, {right + wall, height, front + wall}, plasterSize));
    dark.add(p.wall, slab({left - wall, 0, front}, {right + wall, height, front + wall}, plasterSize));
    dark.add(p.wall, slab({left - wall, 0, -wall}, {doorLeft, height, 0}, plasterSize));
    dark.add(p.wall, slab({doorRight, 0, -wall}, {right + wall, height, 0}, plasterSize));
    dark.add(p.wall, slab({doorLeft, doorHead, -wall}, {doorRight, height, 0}, plasterSize));
    dark.add(p.ceiling, slab({left - wall, height, back - wall}, {right + wall, height + 0.1f, front + wall}, plasterSize));
    glb.addNode(dark);

    Model lit{"lit_room", {}};
    lit.add(p.accent, slab({left - wall, 0, back - wall}, {left, height, -wall}, plasterSize));
    lit.add(p.accent, slab({right, 0, back - wall}, {right + wall, height, -wall}, plasterSize));
    lit.add(p.accent, slab({left, 0, back - wall}, {right, height, back}, plasterSize));
    glb.addNode(lit);

    Model trim{"mouldings", {}};
    constexpr float foot = 0.11f, deep = 0.018f;
    trim.add(p.trim, slab({doorRight + 0.07f, 0, -0.03f}, {right, foot, deep}, 1, 0.006f));
    trim.add(p.trim, slab({left, 0, -0.03f}, {doorLeft - 0.07f, foot, deep}, 1, 0.006f));
    trim.add(p.trim, slab({left - 0.03f, 0, 0}, {left + deep, foot, front}, 1, 0.006f));
    trim.add(p.trim, slab({right - deep, 0, 0}, {right + 0.03f, foot, front}, 1, 0.006f));
    trim.add(p.trim, slab({doorLeft - 0.075f, 0, -0.03f}, {doorLeft + 0.01f, doorHead + 0.075f, 0.022f}, 1, 0.006f));
    trim.add(p.trim, slab({doorRight - 0.01f, 0, -0.03f}, {doorRight + 0.075f, doorHead + 0.075f, 0.022f}, 1, 0.006f));
    trim.add(p.trim, slab({doorLeft - 0.075f, doorHead - 0.01f, -0.03f}, {doorRight + 0.075f, doorHead + 0.075f, 0.024f}, 1, 0.006f));
    glb.addNode(trim);
}

/// A panelled door, hinged on its left edge at the origin, 4 cm thick, its front at z = 0.
Model door(const Palette& p) {
    Model door{"door", {}};
    constexpr float w = doorRight - doorLeft - 0.02f, h = doorHead - 0.015f, stile = 0.12f;
    door.add(p.trim, slab({0.02f, 0.02f, -0.028f}, {w - 0.02f, h - 0.02f, -0.012f}, 1));
    for (float x : {0.0f, w - stile}) door.add(p.trim, slab({x, 0.005f, -0.04f}, {x + stile, h, 0}, 1, 0.004f));
    for (float y : {0.005f, 0.86f, h - stile}) door.add(p.trim, slab({stile - 0.01f, y, -0.0395f}, {w - stile + 0.01f, y + stile, -0.0005f}, 1, 0.004f));
    const Station handle[] = {{{w - 0.06f, 0.98f, -0.005f}, 0.011f},
                              {{w - 0.06f, 0.98f, 0.045f}, 0.010f},
                              {{w - 0.068f, 0.98f, 0.054f}, 0.010f},
                              {{w - 0.17f, 0.98f, 0.054f}, 0.009f}};
    door.add(p.brass, tube(handle, 16));
    door.add(p.brass, slab({w - 0.085f, 0.88f, -0.001f}, {w - 0.035f, 1.06f, 0.004f}, 1, 0.002f));
    return door;
}

/// A walnut wardrobe, back to z = 0, facing +z: what the gap shows of the lit room is dark, or it would outshine the picture.
Model wardrobe(const Palette& p) {
    Model wardrobe{"wardrobe", {}};
    constexpr float w = 1.36f, h = 2.02f, d = 0.5f, stile = 0.09f;
    const auto board = [&](const glm::vec3& low, const glm::vec3& high, Axis grain, uint32_t seed) {
        wardrobe.add(p.walnut, placed(plank(high - low, grain, seed, 0.004f), 0.5f * (low + high)));
    };
    board({-w / 2, 0.08f, 0}, {w / 2, h, d}, Axis::y, 61);
    board({-w / 2 + 0.03f, 0, 0.03f}, {w / 2 - 0.03f, 0.1f, d - 0.03f}, Axis::x, 62);
    board({-w / 2 - 0.03f, h - 0.01f, 0}, {w / 2 + 0.03f, h + 0.04f, d + 0.045f}, Axis::x, 63);
    for (float side : {-1.0f, 1.0f}) {
        const float inner = side * 0.003f, outer = side * (w / 2 - 0.01f), low = std::min(inner, outer), high = std::max(inner, outer);
        const auto seed = uint32_t(70 + side * 5);
        for (float x : {low, high - stile}) board({x, 0.11f, d - 0.01f}, {x + stile, h - 0.03f, d + 0.018f}, Axis::y, seed + (x == low ? 0 : 1));
        for (float y : {0.11f, 0.95f, h - 0.03f - stile})
            board({low + stile - 0.002f, y, d - 0.01f}, {high - stile + 0.002f, y + stile, d + 0.017f}, Axis::x, seed + 2);
        wardrobe.add(p.brass, placed(sphere(20, 12), glm::scale(glm::translate(glm::mat4(1), {side * 0.05f, 1.0f, d + 0.034f}), glm::vec3(0.017f))));
    }
    return wardrobe;
}

}  // namespace

Glb ajarRoom(bool wallMetal) {
    Glb glb;
    const Material plaster = glb.dressed({.name = "plaster"}, paintPlaster(glm::vec3(0.92f), 1, 512));
    const auto tinted = [&](Material material, const std::string& name, const glm::vec3& color) {
        material.name = name;
        material.color = color;
        return glb.addMaterial(material);
    };
    Palette p{};
    p.floor = glb.addMaterial(glb.dressed({.name = "herringbone"}, paintHerringbone(birch(), 23, 768)));
    p.oak = glb.addMaterial(glb.dressed({.name = "oak"}, paintPanel(oak(), 21, 512)));
    p.walnut = glb.addMaterial(glb.dressed({.name = "walnut"}, paintPanel(walnut(), 22, 512)));
    p.wall = wallMetal ? glb.addMaterial({.name = "rough_metal", .color = silver, .roughness = 0.3f, .metalness = 1})
                       : tinted(plaster, "wall", {0.75f, 0.76f, 0.74f});
    p.accent = tinted(plaster, "wall_lit", {0.86f, 0.85f, 0.82f});
    p.ceiling = tinted(plaster, "ceiling", {0.86f, 0.85f, 0.82f});
    p.trim = glb.addMaterial({.name = "trim", .color = {0.74f, 0.71f, 0.66f}, .roughness = 0.35f});
    p.brass = glb.addMaterial({.name = "brass", .color = {0.83f, 0.62f, 0.30f}, .roughness = 0.2f, .metalness = 1});
    p.paper = glb.addMaterial({.name = "paper", .color = {0.74f, 0.69f, 0.58f}, .roughness = 0.9f});
    p.blackMetal = glb.addMaterial({.name = "black_frame", .color = glm::vec3(0.018f), .roughness = 0.3f});
    addShell(glb, p);
    glb.addNode(door(p), {.translation = {doorLeft + 0.01f, 0, 0}, .rotation = turnY(-ajar)});

    glb.addNode(wardrobe(p), {.translation = {left + 0.01f, 0, -1.72f}, .rotation = turnY(90)});

    // An uplighter that leans away from the door: the whole room of the teapots lies behind its plane, so that all light there is indirect.
    const int lamp = glb.addMaterial(glow("lamp", {380, 367, 348})), tray = glb.addMaterial({.name = "tray", .color = glm::vec3(0.6f), .roughness = 0.5f});
    glb.addNode(areaLamp("lamp", lamp, tray, {-0.75f, doorHead + 0.23f, -1.35f}, {0, 1, -0.325f}, {1.3f, 0.6f}));

    const glm::vec3 table(0.42f, 0, 1.02f);
    glb.addNode(diningTable(p, {1.7f, 0.8f}), {.translation = table});
    glb.addNode("chair", glb.addMesh(chair(p)), {.translation = {0.80f, 0, 0.46f}, .rotation = turnY(188)});
    const glm::vec3 board = table + glm::vec3(0, 0.74f, 0);
    const int metal = glb.addMaterial({.name = "metal", .color = silver, .roughness = 0.12f, .metalness = 1});
    const int glass = glb.addMaterial({.name = "glass", .roughness = 0, .transmission = 1, .ior = 1.5f, .thickness = 0.2f,
                                       .attenuation = {0.80f, 0.95f, 0.91f}, .attenuationDistance = 0.4f});
    const int clay = glb.addMaterial(glb.dressed({.name = "clay", .color = {0.62f, 0.25f, 0.13f}}, paintEarthenware(glm::vec3(0.95f), 4, 512)));
    glb.addNode(teapot("teapot_metal", metal, 0.30f), {.translation = board + glm::vec3(-0.56f, 0, 0.08f), .rotation = turnY(28)});
    glb.addNode(teapot("teapot_glass", glass, 0.29f), {.translation = board + glm::vec3(0.02f, 0.0002f, -0.06f), .rotation = turnY(150)});
    glb.addNode(teapot("teapot_clay", clay, 0.31f), {.translation = board + glm::vec3(0.50f, 0, 0.04f), .rotation = turnY(-20)});

    const auto art = [&](const std::string& name, const Textures& picture) { return glb.addMaterial(glb.dressed({.name = name}, picture)); };
    glb.addNode(pictureFrame("print", p, {0.56f, 0.74f}, 0.06f, p.blackMetal, art("art_print", paintPrint(41, 384, 512))), {.translation = {0.10f, 1.62f, 0}});
    glb.addNode(pictureFrame("hills", p, {0.90f, 0.66f}, 0.06f, p.walnut, art("art_hills", paintHills(43, 512, 384))), {.translation = {1.15f, 1.62f, 0}});
    return glb;
}

}  // namespace lodestir::generate
