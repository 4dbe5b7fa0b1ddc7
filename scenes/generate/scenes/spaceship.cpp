// SPDX-License-Identifier: MIT
// A spaceship of solid glass in its hangar above a planet: bubbles and balls of glass within glass, and a star at their middle whose light leaves only
// through them.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/gtc/matrix_transform.hpp>

#include "kit/glass_ship.h"
#include "kit/metals.h"
#include "kit/plating.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/spline.h"
#include "kit/still_life.h"
#include "kit/truss.h"

namespace lodestir::generate {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float half = 15, back = -11, front = 15, height = 9.5f;  ///< the hangar, metres
constexpr float mouth = 11.5f, mouthHeight = 7.6f;                 ///< its opening, in the back wall
const glm::vec3 berth(0, 2.35f, 0);                                ///< where the ship's middle floats

struct Paints {
    int plates, wall, pad, rib, steel, yellow, rubber;
    int strip, ring, cool;
};

Paints addPaints(Glb& glb) {
    const auto glowing = [&](const std::string& name, const glm::vec3& radiance) {
        return glb.addMaterial({.name = name, .color = glm::vec3(0), .emission = radiance});
    };
    Paints p{};
    p.plates = glb.addMaterial(glb.dressed({.name = "plates"}, paintPlates(3, 1024)));
    p.wall = glb.addMaterial({.name = "wall", .color = {0.55f, 0.57f, 0.60f}, .roughness = 0.5f});
    p.pad = glb.addMaterial({.name = "pad", .color = {0.70f, 0.69f, 0.66f}, .roughness = 0.35f});
    p.rib = glb.addMaterial({.name = "rib", .color = {0.14f, 0.15f, 0.17f}, .roughness = 0.45f});
    p.steel = glb.addMaterial({.name = "steel", .color = steel, .roughness = 0.28f, .metalness = 1});
    p.yellow = glb.addMaterial({.name = "yellow_paint", .color = {0.72f, 0.42f, 0.03f}, .roughness = 0.45f});
    p.rubber = glb.addMaterial({.name = "rubber", .color = glm::vec3(0.02f), .roughness = 0.8f});
    p.strip = glowing("strip_light", {14, 15, 17});
    p.ring = glowing("ring_light", {16, 15, 14});
    p.cool = glowing("edge_light", {1.5f, 6, 9});
    return p;
}

void addShip(Glb& glb) {
    // Every body bounds a volume; colours are what a metre or so of the glass leaves of white light.
    const auto glass = [&](const std::string& name, const glm::vec3& left, float distance, float ior) {
        return glb.addMaterial(
            {.name = name, .roughness = 0, .transmission = 1, .ior = ior, .thickness = 1, .attenuation = left, .attenuationDistance = distance});
    };
    const auto glowing = [&](const std::string& name, const glm::vec3& radiance) {
        return glb.addMaterial({.name = name, .color = glm::vec3(0), .emission = radiance});
    };
    ShipMaterials m{};
    m.hull = glass("hull_glass", {0.86f, 0.97f, 0.98f}, 3.0f, 1.40f);
    m.wing = glass("wing_glass", {0.12f, 0.38f, 0.85f}, 0.45f, 1.5f);
    m.amber = glass("amber_glass", {0.95f, 0.50f, 0.10f}, 0.5f, 1.6f);
    m.violet = glass("violet_glass", {0.62f, 0.16f, 0.85f}, 0.25f, 1.6f);
    m.gold = glb.addMaterial({.name = "gold", .color = gold, .roughness = 0.2f, .metalness = 1});
    m.steel = glb.addMaterial({.name = "bright_steel", .color = steel, .roughness = 0.22f, .metalness = 1});
    m.leather = glb.addMaterial({.name = "leather", .color = {0.40f, 0.055f, 0.03f}, .roughness = 0.45f});
    m.dark = glb.addMaterial({.name = "console", .color = glm::vec3(0.03f), .roughness = 0.4f});
    m.star = glowing("star", {150, 88, 36});
    m.plasma = glowing("plasma", {5, 20, 55});
    m.panel = glowing("instruments", {2, 9, 6});
    glb.addNode(glassShip(m), {.translation = berth});
}

/// Three arms that reach up to the hull and end in pads a finger's breadth from it; a round pad below with a ring of light.
void addBerth(Glb& glb, const Paints& paint) {
    Model cradle{"cradle", {}};
    const glm::vec2 disc[] = {{0, 0.10f}, {4.55f, 0.10f}, {4.62f, 0.07f}, {4.68f, 0}};
    cradle.add(paint.pad, turned(disc, 96));
    const glm::vec2 stripe[] = {{3.95f, 0.104f}, {4.2f, 0.104f}};
    cradle.add(paint.yellow, turned(stripe, 96));
    const glm::vec2 glow[] = {{4.32f, 0.105f}, {4.40f, 0.105f}};
    cradle.add(paint.cool, turned(glow, 48));
    for (const glm::vec2& xz : {glm::vec2(1.9f, 0), glm::vec2(-1.6f, 0.85f), glm::vec2(-1.6f, -0.85f)}) {
        const glm::vec2 girth = shipGirth(xz.x);
        const float below = girth.x * std::sqrt(std::max(1 - (xz.y / girth.y) * (xz.y / girth.y), 0.0f));
        const glm::vec3 pad = berth + glm::vec3(xz.x, -below - 0.035f, xz.y), foot(1.45f * xz.x, 0.1f, 2.0f * xz.y);
        const Station arm[] = {{foot, 0.13f},
                               {glm::mix(foot, pad, 0.35f) + glm::vec3(0.12f * xz.x, 0, 0.2f * xz.y), 0.10f},
                               {glm::mix(foot, pad, 0.8f), 0.07f},
                               {pad - glm::vec3(0, 0.07f, 0), 0.06f}};
        cradle.add(paint.steel, limb(arm, 6, 16));
        const glm::vec2 cup[] = {{0, 0.02f}, {0.15f, 0.02f}, {0.17f, 0}, {0.12f, -0.07f}, {0.05f, -0.10f}};
        cradle.add(paint.rubber, placed(turned(cup, 20), pad));
        const glm::vec2 base[] = {{0.18f, 0.22f}, {0.30f, 0.18f}, {0.34f, 0.10f}};
        cradle.add(paint.steel, placed(turned(base, 24), glm::vec3(foot.x, 0, foot.z)));
    }
    glb.addNode(cradle);
}

void addHangar(Glb& glb, const Paints& paint) {
    Model shell{"hangar", {}};
    Mesh floor = rectangle({-half, 0, back - 2}, {2 * half, 0, 0}, {0, 0, front - back + 2});
    scaleUv(floor, glm::vec2(2 * half, front - back + 2) / platesSize);
    shell.add(paint.plates, floor);
    shell.add(paint.wall, rectangle({-half, height, front}, {2 * half, 0, 0}, {0, 0, back - front}));
    shell.add(paint.wall, rectangle({half, height, front}, {-2 * half, 0, 0}, {0, -height, 0}));
    // The back wall around the mouth: two sides and a lintel, a metre thick.
    for (float side : {-1.0f, 1.0f}) {
        shell.add(paint.wall, rectangle({side * half, height, side < 0 ? front : back}, {0, 0, side * (front - back)}, {0, -height, 0}));
        shell.add(paint.wall, placed(roundedBox({half - mouth, height, 1.2f}, 0.05f, 2), {side * (half + mouth) / 2, height / 2, back}));
        shell.add(paint.yellow, placed(roundedBox({0.22f, mouthHeight, 1.3f}, 0.04f, 2), {side * (mouth + 0.06f), mouthHeight / 2, back}));
        shell.add(paint.cool, panel({side * (mouth - 0.07f), mouthHeight / 2, back + 0.45f}, {-side, 0, 0}, {0.08f, mouthHeight - 0.6f}));
    }
    shell.add(paint.wall, placed(roundedBox({2 * half, height - mouthHeight, 1.2f}, 0.05f, 2), {0, (height + mouthHeight) / 2, back}));
    shell.add(paint.yellow, placed(roundedBox({2 * mouth, 0.22f, 1.3f}, 0.04f, 2), {0, mouthHeight + 0.06f, back}));
    glb.addNode(shell);

    // Ribs along both sides, panels between them, light behind each.
    Model bay{"bay", {}};
    bay.add(paint.rib, placed(roundedBox({0.8f, height, 0.55f}, 0.12f, 3), {0.1f, height / 2, 0}));
    bay.add(paint.rib, placed(roundedBox({1.6f, 0.5f, 0.55f}, 0.12f, 3), {0.5f, height - 0.2f, 0}));
    bay.add(paint.strip, panel({0.05f, 4.4f, 0.42f}, {1, 0, 0.35f}, {0.16f, 5.6f}));
    for (float y : {1.4f, 3.5f, 5.6f, 7.7f}) bay.add(paint.wall, placed(roundedBox({0.24f, 1.9f, 2.7f}, 0.08f, 3), {0.02f, y, 2.1f}));
    bay.add(paint.rib, placed(roundedBox({0.3f, 0.25f, 3.6f}, 0.06f, 2), {0.1f, 0.2f, 2.1f}));
    for (float y : {2.45f, 6.65f}) bay.add(paint.steel, bar({0.18f, y, 0.3f}, {0.18f, y, 3.9f}, 0.06f, 10));
    const int bayMesh = glb.addMesh(bay);
    for (int i = 0; i < 6; ++i) {
        const float z = back + 1.2f + 4.2f * float(i);
        glb.addNode("bay_left_" + std::to_string(i), bayMesh, {.translation = {-half, 0, z}});
        glb.addNode("bay_right_" + std::to_string(i), bayMesh, {.translation = {half, 0, z + 4.2f}, .rotation = turnY(180)});
    }
    Model roof{"roof", {}};
    for (float x : {-9.0f, -3.0f, 3.0f, 9.0f}) roof.add(paint.rib, girder({x, height - 1.3f, back + 0.6f}, {x, height - 1.3f, front}, 1.2f, 18, 0.09f, 0.045f));
    constexpr int parts = 32;
    for (int i = 0; i < parts; ++i) {
        const float a = 2 * pi * float(i) / parts, b = 2 * pi * (float(i) + 0.92f) / parts;
        const auto at = [&](float r, float angle) { return glm::vec3(r * std::sin(angle), height - 1.5f, r * std::cos(angle)); };
        Mesh tile;
        for (const glm::vec3& p : {at(3.9f, a), at(3.4f, a), at(3.4f, b), at(3.9f, b)}) tile.add({.position = p, .normal = {0, -1, 0}});
        tile.quad(0, 1, 2, 3);
        computeNormals(tile, 180);
        roof.add(paint.ring, tile);
    }
    const glm::vec2 tray[] = {{4.02f, 0.0f}, {4.02f, 0.14f}, {3.28f, 0.14f}, {3.28f, 0.0f}};
    roof.add(paint.rib, placed(turned(tray, 64), {0, height - 1.51f, 0}));
    glb.addNode(roof);

    // Things that stand about: crates, a trolley of tanks.
    Model cargo{"cargo", {}};
    const auto crate = [&](const glm::vec3& size, const glm::vec3& at, float turn, int material) {
        const glm::mat4 stand = glm::rotate(glm::translate(glm::mat4(1), at + glm::vec3(0, size.y / 2, 0)), glm::radians(turn), {0, 1, 0});
        cargo.add(material, placed(roundedBox(size, 0.05f, 2), stand));
        for (float x : {-0.3f, 0.3f})
            cargo.add(paint.rib,
                      placed(roundedBox({0.12f, size.y + 0.03f, size.z + 0.03f}, 0.03f, 2), stand * glm::translate(glm::mat4(1), {x * size.x, 0, 0})));
    };
    crate({1.6f, 1.2f, 1.2f}, {-9.4f, 0, -5.6f}, 12, paint.yellow);
    crate({1.3f, 1.0f, 1.1f}, {-9.2f, 1.2f, -5.7f}, -8, paint.wall);
    crate({1.8f, 1.4f, 1.3f}, {-11.4f, 0, -4.2f}, 28, paint.wall);
    crate({1.2f, 0.9f, 1.0f}, {7.6f, 0, -6.8f}, -20, paint.yellow);
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 at(-7.6f + 0.62f * float(i), 0.25f, -7.4f + 0.2f * float(i));
        const glm::vec2 tank[] = {{0, 1.45f}, {0.10f, 1.42f}, {0.24f, 1.30f}, {0.27f, 1.15f}, {0.27f, 0.2f}, {0.24f, 0.05f}, {0.1f, 0}};
        cargo.add(i == 1 ? paint.yellow : paint.steel, placed(turned(smoothCurve(tank, 4), 28), at));
    }
    glb.addNode(cargo);
}

/// The planet outside, which is no lamp, and a floodlight beside the mouth, where the sun would be: light for the glass to throw about.
void addSpace(Glb& glb, const Paints& paint) {
    Model planet{"planet", {}};
    const glm::quat tip = glm::angleAxis(0.5f, glm::vec3(0, 0, 1)) * turnY(70);
    const glm::vec3 sun = glm::normalize(glm::vec3(0.85f, 0.45f, 0.45f));
    Material surface{.name = "planet"};
    surface.unlit = true;
    planet.add(glb.addMaterial(glb.dressed(surface, paintPlanet(14, 2048, glm::inverse(tip) * sun))),
               placed(sphere(160, 80), glm::scale(glm::mat4(1), glm::vec3(150))));
    glb.addNode(planet, {.translation = {-152, -112, -208}, .rotation = tip});
    const glm::vec3 at(10.5f, 8.5f, back - 8.5f);
    glb.addNode(areaLamp("floodlight", glb.addMaterial({.name = "floodlight", .color = glm::vec3(0), .emission = {330, 295, 250}}), paint.rib, at, berth - at,
                         {1.8f, 1.8f}));
}

Glb makeSpaceship() {
    Glb glb;
    const Paints paint = addPaints(glb);
    addShip(glb);
    addBerth(glb, paint);
    addHangar(glb, paint);
    addSpace(glb, paint);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeSpaceship)

}  // namespace lodestir::generate
