// SPDX-License-Identifier: MIT
// A bathroom in the morning: all daylight comes through a pane and then a shower of glass; two mirrors face each other across the room.
#include <glm/gtc/matrix_transform.hpp>

#include "kit/cloth.h"
#include "kit/foliage.h"
#include "kit/furniture.h"
#include "kit/grip.h"
#include "kit/joinery.h"
#include "kit/masonry.h"
#include "kit/metals.h"
#include "kit/noise.h"
#include "kit/plumbing.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/slab.h"
#include "kit/still_life.h"
#include "kit/tableware.h"
#include "kit/tiles.h"
#include "kit/wood.h"

namespace lodestir::generate {

namespace {

constexpr float left = -1.8f, right = 1.8f, back = -1.9f, front = 2.4f, height = 2.5f, wall = 0.2f;  ///< of the room, metres
constexpr glm::vec2 windowLow(0.64f, 0.86f), windowHigh(1.66f, 2.24f);                               ///< in the back wall: x, y
constexpr float showerLeft = 0.45f, showerFront = -0.72f, showerHeight = 2.02f;
constexpr float ledge = 0.64f;  ///< height of the shelf behind the tub

const Tiling bricks{.tile = {0.15f, 0.075f}, .count = {4, 8}, .bond = true, .color = {0.63f, 0.72f, 0.66f}, .second = {0.63f, 0.72f, 0.66f},
                    .grout = {0.70f, 0.69f, 0.65f}, .tone = 0.10f, .tilt = 0.006f};
const Tiling marble{.tile = {0.45f, 0.45f}, .count = {2, 2}, .color = {0.84f, 0.83f, 0.81f}, .second = {0.84f, 0.83f, 0.81f},
                    .grout = {0.40f, 0.39f, 0.37f}, .edge = 0.003f, .roughness = 0.12f, .tone = 0.03f, .tilt = 0.001f, .wave = 0, .veins = 1};

struct Paints {
    Palette kit;
    int bricks, marble, plaster, chrome, mirror, glass, edge, window, enamel, towel, amber, soap, dark;
};

Paints addPaints(Glb& glb) {
    Paints p{};
    p.bricks = glb.addMaterial(glb.dressed({.name = "wall_tiles"}, paintTiles(bricks, 3, 768)));
    p.marble = glb.addMaterial(glb.dressed({.name = "marble"}, paintTiles(marble, 4, 768)));
    p.plaster = glb.addMaterial(glb.dressed({.name = "plaster"}, paintPlaster({0.87f, 0.86f, 0.83f}, 1, 512)));
    p.chrome = glb.addMaterial({.name = "chrome", .color = chrome, .roughness = 0.04f, .metalness = 1});
    p.mirror = glb.addMaterial({.name = "mirror", .color = silver, .roughness = 0, .metalness = 1});
    // Panes are sheets, one surface each: light crosses the shower straight, and the frosted window spreads it.
    p.glass = glb.addMaterial({.name = "shower_glass", .color = {0.93f, 0.97f, 0.95f}, .roughness = 0, .transmission = 1, .doubleSided = true});
    p.window = glb.addMaterial({.name = "frosted_pane", .color = {0.97f, 0.98f, 0.98f}, .roughness = 0.4f, .transmission = 1, .doubleSided = true});
    p.edge = glb.addMaterial({.name = "cut_edge", .color = {0.10f, 0.34f, 0.26f}, .roughness = 0.1f});
    p.enamel = glb.addMaterial({.name = "enamel", .color = {0.86f, 0.86f, 0.84f}, .roughness = 0.08f});
    Material weave = glb.dressed({.name = "weave"}, paintWeave(2, 256));
    const auto dyed = [&](const char* name, const glm::vec3& color) {
        weave.name = name;
        weave.color = color;
        return glb.addMaterial(weave);
    };
    p.towel = dyed("towel", {0.66f, 0.30f, 0.16f});
    p.kit.linen = dyed("bath_mat", {0.80f, 0.77f, 0.70f});
    p.amber = glb.addMaterial({.name = "amber_glass", .roughness = 0, .transmission = 1, .thickness = 0.06f, .attenuation = {0.80f, 0.36f, 0.08f},
                               .attenuationDistance = 0.03f});
    p.soap = glb.addMaterial({.name = "porcelain", .color = {0.82f, 0.80f, 0.76f}, .roughness = 0.2f});
    p.dark = glb.addMaterial({.name = "black", .color = glm::vec3(0.02f), .roughness = 0.35f});
    p.kit.walnut = glb.addMaterial(glb.dressed({.name = "walnut"}, paintPanel(walnut(), 22, 512)));
    p.kit.trim = glb.addMaterial({.name = "trim", .color = {0.78f, 0.77f, 0.74f}, .roughness = 0.3f});
    p.kit.clay = glb.addMaterial(glb.dressed({.name = "clay", .color = {0.80f, 0.76f, 0.70f}}, paintEarthenware(glm::vec3(0.95f), 4, 256)));
    p.kit.leaf = glb.addMaterial(glb.dressed({.name = "leaf", .mask = true, .doubleSided = true}, paintLeaf(6, 256)));
    p.kit.stem = glb.addMaterial({.name = "stem", .color = {0.13f, 0.10f, 0.05f}, .roughness = 0.7f});
    p.kit.soil = glb.addMaterial({.name = "soil", .color = {0.035f, 0.024f, 0.016f}, .roughness = 1});
    return p;
}

/// A single part as a node.
void put(Glb& glb, const char* name, int material, const Mesh& mesh, const Placement& placement = {}) {
    Model model{name, {}};
    model.add(material, mesh);
    glb.addNode(model, placement);
}

void addShell(Glb& glb, const Paints& p) {
    put(glb, "floor", p.marble, facing(plainBox({right - left + 2 * wall, 0.1f, front - back + 2 * wall}), marble.size()),
        {.translation = {0, -0.05f, (front + back) / 2}});
    Model walls{"walls", {}};
    const auto tiled = [&](const glm::vec3& low, const glm::vec3& high, float bevel = 0) {
        walls.add(p.bricks, facing(slab(low, high, 1, bevel), bricks.size()));
    };
    tiled({left - wall, 0, back - wall}, {windowLow.x, height, back});
    tiled({windowHigh.x, 0, back - wall}, {right + wall, height, back});
    tiled({windowLow.x, 0, back - wall}, {windowHigh.x, windowLow.y, back});
    tiled({windowLow.x, windowHigh.y, back - wall}, {windowHigh.x, height, back});
    tiled({right, 0, back}, {right + wall, height, front});
    tiled({left, 0, back}, {showerLeft - 0.01f, ledge, back + 0.15f}, 0.004f);
    walls.add(p.plaster, slab({left - wall, 0, back}, {left, height, front}, plasterSize));
    walls.add(p.plaster, slab({left - wall, 0, front}, {right + wall, height, front + wall}, plasterSize));
    walls.add(p.plaster, slab({left - wall, height, back - wall}, {right + wall, height + 0.1f, front + wall}, plasterSize));
    glb.addNode(walls);

    Model trim{"joinery", {}};
    const auto board = [&](const glm::vec3& low, const glm::vec3& high) { trim.add(p.kit.trim, slab(low, high, 1, 0.006f)); };
    board({left - 0.02f, 0, back + 0.15f}, {left + 0.016f, 0.10f, front});
    board({left, 0, front - 0.016f}, {-0.55f, 0.10f, front + 0.02f});
    board({0.45f, 0, front - 0.016f}, {right, 0.10f, front + 0.02f});
    // The door behind the camera shows in the mirrors.
    board({-0.54f, 0, front - 0.03f}, {-0.46f, 2.12f, front + 0.02f});
    board({0.36f, 0, front - 0.03f}, {0.44f, 2.12f, front + 0.02f});
    board({-0.54f, 2.04f, front - 0.03f}, {0.44f, 2.12f, front + 0.02f});
    glb.addNode(trim);
    put(glb, "door", p.kit.walnut, placed(plank({0.82f, 2.04f, 0.04f}, Axis::y, 9), {-0.05f, 1.02f, front - 0.01f}));

    Model window{"window", {}};
    const float z = back - 0.12f, middle = (windowLow.y + windowHigh.y) / 2 + 0.18f;
    const auto bar = [&](const glm::vec2& low, const glm::vec2& high, float deep) {
        window.add(p.kit.trim, slab({low.x, low.y, z - deep}, {high.x, high.y, z + deep}, 1, 0.006f));
    };
    constexpr float frame = 0.055f;
    bar(windowLow, {windowLow.x + frame, windowHigh.y}, 0.035f);
    bar({windowHigh.x - frame, windowLow.y}, windowHigh, 0.035f);
    bar(windowLow, {windowHigh.x, windowLow.y + frame}, 0.035f);
    bar({windowLow.x, windowHigh.y - frame}, windowHigh, 0.035f);
    bar({windowLow.x + 0.02f, middle - 0.022f}, {windowHigh.x - 0.02f, middle + 0.022f}, 0.025f);
    const float half = (windowLow.x + windowHigh.x) / 2;
    bar({half - 0.015f, windowLow.y + 0.02f}, {half + 0.015f, windowHigh.y - 0.02f}, 0.018f);
    window.add(p.window, rectangle({windowLow.x, windowHigh.y, z}, {windowHigh.x - windowLow.x, 0, 0}, {0, windowLow.y - windowHigh.y, 0}));
    window.add(p.kit.trim, slab({windowLow.x - 0.03f, windowLow.y - 0.012f, z}, {windowHigh.x + 0.03f, windowLow.y + 0.014f, back + 0.03f}, 1, 0.006f));
    glb.addNode(window);
}

void addShower(Glb& glb, const Paints& p) {
    Model cabin{"shower_cabin", {}};
    constexpr float foot = 0.05f, split = 1.12f;
    cabin.add(p.enamel, slab({showerLeft - 0.01f, 0, back}, {right, foot, showerFront + 0.02f}, 1, 0.010f));
    const auto edge = [&](const glm::vec3& low, const glm::vec3& high) { cabin.add(p.edge, slab(low, high, 1)); };
    const auto metal = [&](const glm::vec3& low, const glm::vec3& high) { cabin.add(p.chrome, slab(low, high, 1, 0.003f)); };
    const float h = showerHeight - foot;
    cabin.add(p.glass, rectangle({showerLeft, showerHeight, back}, {0, 0, showerFront - back}, {0, -h, 0}));
    edge({showerLeft - 0.004f, showerHeight, back}, {showerLeft + 0.004f, showerHeight + 0.002f, showerFront});
    cabin.add(p.glass, rectangle({showerLeft, showerHeight, showerFront}, {split - showerLeft, 0, 0}, {0, -h, 0}));
    edge({showerLeft, showerHeight, showerFront - 0.004f}, {split, showerHeight + 0.002f, showerFront + 0.004f});
    edge({split - 0.001f, foot, showerFront - 0.004f}, {split + 0.001f, showerHeight, showerFront + 0.004f});
    metal({showerLeft - 0.010f, foot, showerFront - 0.010f}, {showerLeft + 0.010f, showerHeight, showerFront + 0.010f});
    metal({showerLeft - 0.009f, foot, back}, {showerLeft + 0.009f, showerHeight, back + 0.018f});
    metal({showerLeft, foot, showerFront - 0.009f}, {split, foot + 0.016f, showerFront + 0.009f});
    metal({showerLeft - 0.009f, foot, back}, {showerLeft + 0.009f, foot + 0.016f, showerFront});
    cabin.add(p.chrome, bar({split - 0.1f, showerHeight - 0.03f, showerFront}, {right, showerHeight - 0.03f, showerFront}, 0.009f, 20));
    cabin.add(p.chrome, bar({1.25f, foot, back + 0.5f}, {1.25f, foot + 0.004f, back + 0.5f}, 0.055f, 32));
    glb.addNode(cabin);

    // The leaf is hinged at the wall and stands a little open, into the room.
    Model door{"shower_door", {}};
    constexpr float w = 0.655f, low = foot + 0.012f;
    door.add(p.glass, rectangle({-w, showerHeight, 0}, {w, 0, 0}, {0, low - showerHeight, 0}));
    door.add(p.edge, slab({-w - 0.001f, low, -0.004f}, {-w + 0.001f, showerHeight, 0.004f}, 1));
    door.add(p.edge, slab({-w, showerHeight, -0.004f}, {0, showerHeight + 0.002f, 0.004f}, 1));
    for (float y : {0.30f, showerHeight - 0.30f}) door.add(p.chrome, slab({-0.055f, y, -0.012f}, {0.02f, y + 0.09f, 0.012f}, 1, 0.003f));
    for (float side : {-1.0f, 1.0f})
        door.add(p.chrome, grip({-w + 0.05f, 0.95f, 0}, {-w + 0.05f, 1.25f, 0}, {0, 0, side * 0.05f}, 0.008f));
    glb.addNode(door, {.translation = {right - 0.015f, 0, showerFront}, .rotation = turnY(22)});
    glb.addNode(shower("shower", p.chrome, 2.12f, 0.42f), {.translation = {right, 0, -1.32f}, .rotation = turnY(-90)});
}

void addVanity(Glb& glb, const Paints& p) {
    constexpr float low = -0.42f, high = 0.98f, middle = (low + high) / 2, deep = 0.50f, top = 0.84f;
    Model cabinet{"vanity", {}};
    const auto board = [&](const glm::vec3& a, const glm::vec3& b, Axis grain, uint32_t seed) {
        cabinet.add(p.kit.walnut, placed(plank(b - a, grain, seed, 0.003f), 0.5f * (a + b)));
    };
    board({left, 0.34f, low}, {left + deep - 0.03f, top - 0.03f, high}, Axis::z, 1);
    for (int i = 0; i < 2; ++i) {
        const float z0 = i == 0 ? low : middle + 0.002f, z1 = i == 0 ? middle - 0.002f : high, x = left + deep - 0.03f;
        for (const glm::vec2& y : {glm::vec2(0.34f, 0.572f), glm::vec2(0.576f, top - 0.034f)}) {
            board({x, y.x, z0}, {x + 0.02f, y.y, z1}, Axis::z, uint32_t(20 + 3 * i + int(y.x * 7)));
            const float z = (z0 + z1) / 2, rail = y.y - 0.045f;
            cabinet.add(p.chrome, grip({x + 0.018f, rail, z - 0.08f}, {x + 0.018f, rail, z + 0.08f}, {0.028f, 0, 0}, 0.005f));
        }
    }
    cabinet.add(p.marble, facing(slab({left, top - 0.03f, low - 0.01f}, {left + deep, top, high + 0.01f}, 1, 0.004f), marble.size()));
    glb.addNode(cabinet);

    glb.addNode(basin("basin", p.enamel, {0.38f, 0.135f, 0.56f}, 2.6f), {.translation = {left + 0.26f, top, middle}});
    glb.addNode(tap("basin_tap", p.chrome, 0.29f, 0.15f), {.translation = {left + 0.045f, top, middle}, .rotation = turnY(90)});
    glb.addNode(vase("soap_bottle", p.amber, 0.15f, 0.034f), {.translation = {left + 0.20f, top, high - 0.16f}});
    glb.addNode(vase("oil_bottle", p.amber, 0.19f, 0.028f), {.translation = {left + 0.11f, top, high - 0.09f}});
    glb.addNode(mug("beaker", p.soap), {.translation = {left + 0.14f, top, low + 0.14f}, .rotation = turnY(-30)});

    Model mirror{"mirror", {}};
    const float y0 = 1.08f, y1 = 1.98f, z0 = low + 0.06f, z1 = high - 0.06f;
    mirror.add(p.mirror, rectangle({left + 0.022f, y1, z1}, {0, 0, z0 - z1}, {0, y0 - y1, 0}));
    mirror.add(p.dark, slab({left, y0, z0}, {left + 0.021f, y1, z1}, 1));
    for (const glm::vec2& y : {glm::vec2(y0 - 0.012f, y0 + 0.002f), glm::vec2(y1 - 0.002f, y1 + 0.012f)})
        mirror.add(p.dark, slab({left, y.x, z0 - 0.012f}, {left + 0.028f, y.y, z1 + 0.012f}, 1, 0.003f));
    for (const glm::vec2& z : {glm::vec2(z0 - 0.012f, z0 + 0.002f), glm::vec2(z1 - 0.002f, z1 + 0.012f)})
        mirror.add(p.dark, slab({left, y0, z.x}, {left + 0.028f, y1, z.y}, 1, 0.003f));
    glb.addNode(mirror);
    glb.addNode(areaLamp("mirror_lamp", glb.addMaterial(glow("lamp", {46, 37, 26})), p.chrome, {left + 0.075f, y1 + 0.09f, middle}, {1, -0.7f, 0},
                         {0.90f, 0.035f}));
}

/// A ladder of chrome tubes on the left wall with a towel over one of its bars.
void addRadiator(Glb& glb, const Paints& p) {
    constexpr float z0 = -0.98f, z1 = -0.54f, low = 0.35f, high = 1.72f;
    const float x = left + 0.075f;
    Model ladder{"radiator", {}};
    for (float z : {z0, z1}) {
        ladder.add(p.chrome, bar({x, low, z}, {x, high, z}, 0.016f, 24));
        for (float y : {low + 0.08f, high - 0.08f}) ladder.add(p.chrome, bar({left, y, z}, {x, y, z}, 0.011f, 16));
    }
    for (int i = 0; i < 13; ++i) {
        const float y = low + 0.05f + 0.094f * float(i) + (i > 7 ? 0.09f : 0.0f);
        ladder.add(p.chrome, bar({x + 0.016f, y, z0}, {x + 0.016f, y, z1}, 0.0095f, 16));
    }
    glb.addNode(ladder);

    // Over the bar and down on both sides, with the slack of heavy cloth.
    const Noise noise{5};
    const float bar0 = high - 0.075f;
    Mesh towel = grid(28, 60, [&](float u, float v) {
        const float run = 1.25f * v - 0.70f, turn = glm::clamp(run / 0.022f, -1.0f, 1.0f);  // metres from the top, forward side first
        const float down = std::max(std::abs(run) - 0.022f, 0.0f);
        const float slack = 0.012f * noise.fractal({u * 3, down * 2.5f, turn}, 2) * glm::smoothstep(0.0f, 0.3f, down);
        return glm::vec3(x + 0.016f + 0.019f * -turn + slack, bar0 + 0.016f * (1 - turn * turn) - down, glm::mix(z1 - 0.05f, z0 + 0.07f, u) + 0.2f * slack);
    });
    scaleUv(towel, glm::vec2(0.32f, 1.25f) / weaveSize);
    put(glb, "towel", p.towel, towel);
}

Glb makeBathroom() {
    Glb glb;
    const Paints p = addPaints(glb);
    addShell(glb, p);
    addShower(glb, p);
    addVanity(glb, p);
    addRadiator(glb, p);

    const glm::vec3 tub(-0.82f, 0, back + 0.56f);
    glb.addNode(basin("bathtub", p.enamel, {1.66f, 0.58f, 0.76f}, 2.5f), {.translation = tub});
    glb.addNode(tap("bath_tap", p.chrome, 0.24f, 0.26f), {.translation = {tub.x, ledge, back + 0.075f}});
    glb.addNode(vase("bath_oil", p.amber, 0.20f, 0.032f), {.translation = {tub.x + 0.46f, ledge, back + 0.08f}});
    glb.addNode(vase("salts", p.soap, 0.14f, 0.045f), {.translation = {tub.x + 0.60f, ledge, back + 0.075f}});
    glb.addNode(pot("ledge_pot", p.kit.clay, p.kit.soil, 0.13f), {.translation = {tub.x - 0.62f, ledge, back + 0.075f}});
    glb.addNode(rubberFig("ledge_plant", 9, 0.36f, 12, {p.kit.leaf, p.kit.stem}), {.translation = {tub.x - 0.62f, ledge + 0.10f, back + 0.085f}});

    put(glb, "bath_mat", p.kit.linen, facing(slab({-1.15f, 0, -0.78f}, {-0.45f, 0.018f, -0.30f}, 1, 0.008f), glm::vec2(weaveSize)));
    const glm::vec3 stool(0.10f, 0, -0.62f);
    glb.addNode(sideTable(p.kit, 0.17f, 0.44f), {.translation = stool});
    glb.addNode(pot("pot", p.kit.clay, p.kit.soil, 0.15f), {.translation = stool + glm::vec3(0, 0.44f, 0)});
    glb.addNode(rubberFig("plant", 21, 0.55f, 18, {p.kit.leaf, p.kit.stem}), {.translation = stool + glm::vec3(0, 0.56f, 0)});

    Model tall{"tall_mirror", {}};
    tall.add(p.mirror, rectangle({right - 0.026f, 2.0f, -0.25f}, {0, 0, 0.75f}, {0, -1.7f, 0}));
    tall.add(p.dark, slab({right - 0.025f, 0.285f, -0.265f}, {right, 2.015f, 0.515f}, 1, 0.003f));
    glb.addNode(tall);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeBathroom)

}  // namespace lodestir::generate
