// SPDX-License-Identifier: MIT
// An opera house seen from its stage: four tiers of boxes in a horseshoe, over four hundred small lamps, gilded friezes, rows of velvet seats.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "kit/cloth.h"
#include "kit/gilding.h"
#include "kit/lamps.h"
#include "kit/metals.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/spline.h"
#include "kit/still_life.h"
#include "kit/wood.h"

namespace lodestir::generate {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float radius = 10, arm = 9.6f, middle = -4;  ///< the horseshoe: half a circle around z = middle, and straight arms towards the stage
constexpr float length = 2 * arm + pi * radius;
constexpr int boxes = 21, tiers = 4;
constexpr float firstTier = 2.15f, storey = 3.0f, boxDepth = 2.3f, ceiling = firstTier + storey * tiers + 0.5f;

/// A place on the horseshoe: where, and which way is into the hall.
struct Stand {
    glm::vec3 position, inward;
    glm::quat facing() const { return turnY(glm::degrees(std::atan2(inward.x, inward.z))); }
};

/// `share` from 0 at the left end of the horseshoe, seen from the stage's back, to 1; `out` metres outside of it.
Stand standAt(float share, float out, float height) {
    const float s = share * length;
    if (s < arm) return {{-radius - out, height, middle + arm - s}, {1, 0, 0}};
    if (s > length - arm) return {{radius + out, height, middle + arm - (length - s)}, {-1, 0, 0}};
    const float a = (s - arm) / radius;
    const glm::vec3 outward(-std::cos(a), 0, -std::sin(a));
    return {glm::vec3(0, height, middle) + (radius + out) * outward, -outward};
}

std::vector<glm::vec3> horseshoe(float out, float height) {
    std::vector<glm::vec3> path;
    for (int i = 0; i <= 168; ++i) path.push_back(standAt(float(i) / 168, out, height).position);
    return path;
}

Mesh sweep(float out, float height, std::vector<glm::vec2> profile, const glm::vec2& repeat = glm::vec2(1)) {
    Mesh mesh = moulding(horseshoe(out, height), profile);
    scaleUv(mesh, 1.0f / repeat);
    return mesh;
}

struct Paints {
    int gilt, frieze, cream, velvet, damask, wood, carpet, dark, iron, ceiling;
    int flame, crystal, sconce;
};

Paints addPaints(Glb& glb) {
    Paints p{};
    Material weave = glb.dressed({.name = "weave"}, paintWeave(2, 256));
    const auto dyed = [&](const std::string& name, const glm::vec3& color, const glm::vec3& sheen) {
        Material cloth = weave;
        cloth.name = name, cloth.color = color, cloth.doubleSided = true;
        cloth.sheen = sheen, cloth.sheenRoughness = 0.35f;
        return glb.addMaterial(cloth);
    };
    p.gilt = glb.addMaterial(glb.dressed({.name = "gold_leaf"}, paintGoldLeaf(5, 512)));
    p.frieze = glb.addMaterial(glb.dressed({.name = "frieze"}, paintFrieze({0.78f, 0.70f, 0.54f}, 6, 768)));
    p.cream = glb.addMaterial({.name = "cream", .color = {0.78f, 0.70f, 0.54f}, .roughness = 0.45f});
    p.velvet = dyed("velvet", {0.42f, 0.018f, 0.024f}, {0.45f, 0.10f, 0.08f});
    p.damask = dyed("damask", {0.40f, 0.040f, 0.035f}, glm::vec3(0));
    p.carpet = dyed("carpet", {0.26f, 0.020f, 0.022f}, glm::vec3(0));
    p.wood = glb.addMaterial(glb.dressed({.name = "walnut"}, paintPanel(walnut(), 7, 512)));
    p.dark = glb.addMaterial({.name = "stage_black", .color = glm::vec3(0.02f), .roughness = 0.8f});
    p.iron = glb.addMaterial({.name = "iron", .color = glm::vec3(0.03f), .roughness = 0.4f});
    p.ceiling = glb.addMaterial(glb.dressed({.name = "ceiling"}, paintCeiling(8, 1280, 21)));
    p.flame = glb.addMaterial({.name = "flame", .color = glm::vec3(0), .emission = {30, 17.5f, 7.6f}});
    p.sconce = glb.addMaterial({.name = "sconce", .color = glm::vec3(0), .emission = {9, 5.0f, 2.0f}});
    p.crystal = glb.addMaterial({.name = "crystal", .roughness = 0, .transmission = 1, .ior = 1.6f, .thickness = 0.05f});
    return p;
}

/// Floors, parapets and back walls: what runs along the whole horseshoe.
void addTiers(Glb& glb, const Paints& paint) {
    Model shell{"tiers", {}};
    for (int tier = 0; tier < tiers; ++tier) {
        const float y = firstTier + storey * float(tier);
        shell.add(paint.velvet, sweep(0, y, {{-0.16f, 0.86f}, {-0.12f, 0.93f}, {0.0f, 0.95f}, {0.10f, 0.93f}, {0.13f, 0.87f}}, glm::vec2(weaveSize)));
        shell.add(paint.gilt, sweep(0, y, {{0.12f, 0.88f}, {0.16f, 0.85f}, {0.15f, 0.80f}, {0.10f, 0.77f}, {0.07f, 0.73f}}));
        // The bulging front; v spans its height once.
        std::vector<glm::vec2> belly;
        for (int i = 0; i <= 8; ++i) {
            const float t = float(i) / 8;
            belly.push_back({0.07f + 0.13f * std::sin(pi * (0.12f + 0.88f * t)) * (0.45f + 0.55f * t), glm::mix(0.73f, 0.0f, t)});
        }
        float around = 0;
        for (size_t i = 1; i < belly.size(); ++i) around += glm::distance(belly[i - 1], belly[i]);
        shell.add(paint.frieze, sweep(0, y, belly, {friezeSize.x, around}));
        shell.add(
            paint.gilt,
            sweep(0, y, {{0.06f, 0.02f}, {0.13f, 0.0f}, {0.15f, -0.05f}, {0.11f, -0.10f}, {0.13f, -0.15f}, {0.10f, -0.22f}, {0.02f, -0.26f}, {0, -0.32f}}));
        shell.add(paint.cream, sweep(0, y, {{0, -0.32f}, {-boxDepth, -0.32f}}));
        shell.add(paint.carpet, sweep(0, y, {{-boxDepth, 0}, {0, 0}}, glm::vec2(weaveSize)));
        shell.add(paint.damask, sweep(0, y, {{0, 0}, {-0.02f, 0.86f}}, glm::vec2(weaveSize)));
        shell.add(paint.damask, sweep(boxDepth, y, {{0, storey - 0.3f}, {0, 0}}, glm::vec2(weaveSize)));
    }
    // The cornice under the ceiling, and the wall of the stalls.
    const float top = firstTier + storey * tiers;
    shell.add(paint.gilt, sweep(0, top, {{0.02f, -0.32f}, {0.08f, -0.25f}, {0.06f, -0.15f}, {0.20f, -0.05f}, {0.35f, 0.06f}, {0.38f, 0.16f}, {0.30f, 0.22f}}));
    shell.add(paint.cream, sweep(0, top, {{0, -0.32f}, {-boxDepth, -0.32f}}));
    shell.add(paint.frieze, sweep(0, top, {{0.30f, 0.22f}, {0.24f, 0.52f}}, {friezeSize.x, 0.306f}));
    shell.add(paint.damask, sweep(0.05f, 0, {{0, firstTier - 0.3f}, {0, 1.0f}}, glm::vec2(weaveSize)));
    shell.add(paint.gilt, sweep(0.05f, 0, {{0, 1.06f}, {0.04f, 1.04f}, {0.04f, 0.98f}, {0, 0.96f}}));
    shell.add(paint.wood, sweep(0.05f, 0, {{0.01f, 0.97f}, {0.01f, 0}}, panelSize));
    glb.addNode(shell);
}

/// What stands at the edges of boxes: a partition, a slender gilt column, a bracket of three lamps.
void addColumns(Glb& glb, const Paints& paint) {
    Model post{"box_column", {}};
    const float h = storey - 0.32f;
    const glm::vec2 control[] = {{0.11f, h},      {0.12f, h - 0.06f}, {0.06f, h - 0.18f}, {0.055f, h - 0.24f}, {0.045f, 0.5f * h + 0.4f},
                                 {0.055f, 1.15f}, {0.085f, 1.08f},    {0.085f, 0.95f}};
    post.add(paint.gilt, placed(turned(smoothCurve(control, 2), 12), {0, 0, 0.03f}));
    Mesh wall = placed(roundedBox({0.10f, storey - 0.3f, boxDepth}, 0.02f, 1), {0, (storey - 0.3f) / 2, -boxDepth / 2});
    scaleUv(wall, glm::vec2(1 / weaveSize));
    post.add(paint.damask, wall);
    Model lamp{"bracket", {}};
    const float foot = 0.62f;
    lamp.add(paint.gilt, placed(bent(sphere(12, 8), [](const glm::vec3& p) { return p * glm::vec3(0.10f, 0.17f, 0.05f); }), {0, foot + 0.02f, 0.17f}));
    for (float side : {-1.0f, 0.0f, 1.0f}) {
        const glm::vec3 cup(0.20f * side, foot + 0.16f + 0.08f * (1 - std::abs(side)), 0.42f - 0.07f * std::abs(side));
        const Station curve[] = {
            {{0, foot - 0.05f, 0.18f}, 0.017f}, {{0.10f * side, foot - 0.08f, 0.33f}, 0.015f}, {{cup.x, cup.y - 0.12f, cup.z}, 0.013f}, {cup, 0.013f}};
        lamp.add(paint.gilt, limb(curve, 3, 6));
        const glm::vec2 bowl[] = {{0.045f, 0.03f}, {0.04f, 0.01f}, {0.012f, 0}};
        lamp.add(paint.gilt, placed(turned(bowl, 8), cup));
        lamp.add(paint.flame, bulb(cup + glm::vec3(0, 0.075f, 0), 0.042f));
    }
    const int postMesh = glb.addMesh(post), lampMesh = glb.addMesh(lamp);
    for (int tier = 0; tier < tiers; ++tier)
        for (int i = 0; i <= boxes; ++i) {
            const Stand stand = standAt(float(i) / boxes, 0, firstTier + storey * float(tier));
            const std::string name = std::to_string(tier) + "_" + std::to_string(i);
            glb.addNode("column_" + name, postMesh, {.translation = stand.position, .rotation = stand.facing()});
            if (i > 0 && i < boxes) glb.addNode("bracket_" + name, lampMesh, {.translation = stand.position, .rotation = stand.facing()});
        }
}

/// What hangs and stands in a box: a valance with fringe, drawn curtains, a lamp on the back wall, two chairs' backs.
void addBoxes(Glb& glb, const Paints& paint) {
    constexpr float width = length / boxes;
    Model box{"box", {}};
    const float top = storey - 0.34f;
    Mesh valance = grid(24, 3, [&](float u, float v) {
        const float swag = 0.22f + 0.20f * std::abs(std::cos(pi * 2 * u));
        return glm::vec3((u - 0.5f) * (width - 0.12f), top - v * swag, 0.015f + 0.02f * std::sin(40 * u) * v);
    });
    scaleUv(valance, {width / weaveSize, 0.4f / weaveSize});
    box.add(paint.velvet, valance);
    std::vector<Station> fringe;
    for (int i = 0; i <= 24; ++i) {
        const float u = float(i) / 24;
        fringe.push_back({{(u - 0.5f) * (width - 0.12f), top - 0.22f - 0.20f * std::abs(std::cos(pi * 2 * u)), 0.03f}, 0.018f});
    }
    box.add(paint.gilt, tube(fringe, 5));
    for (float side : {-1.0f, 1.0f}) {
        Mesh drape = grid(12, 8, [&](float u, float v) {
            const float tie = 0.42f - 0.26f * std::sin(pi * std::min(v * 1.25f, 1.0f)) * v;  // gathered at its lower third
            return glm::vec3(side * (width / 2 - 0.07f - u * tie), top - v * (top - 0.2f), -0.05f + 0.03f * std::sin(22 * u + 2 * side));
        });
        scaleUv(drape, {0.5f / weaveSize, 2.2f / weaveSize});
        box.add(paint.velvet, drape);
    }
    box.add(paint.gilt, placed(bent(sphere(10, 6), [](const glm::vec3& p) { return p * glm::vec3(0.10f, 0.16f, 0.05f); }), {0, 1.85f, -boxDepth + 0.03f}));
    box.add(paint.sconce, bulb({0, 2.0f, -boxDepth + 0.12f}, 0.055f));
    for (float x : {-0.5f, 0.5f}) {
        box.add(paint.gilt, placed(roundedBox({0.46f, 0.55f, 0.06f}, 0.03f, 2), {x, 0.78f, -0.85f}));
        Mesh back = placed(roundedBox({0.38f, 0.46f, 0.08f}, 0.03f, 2), {x, 0.78f, -0.84f});
        scaleUv(back, glm::vec2(1 / weaveSize));
        box.add(paint.velvet, back);
    }
    const int mesh = glb.addMesh(box);
    for (int tier = 0; tier < tiers; ++tier)
        for (int i = 0; i < boxes; ++i) {
            const Stand stand = standAt((float(i) + 0.5f) / boxes, 0, firstTier + storey * float(tier));
            glb.addNode("box_" + std::to_string(tier) + "_" + std::to_string(i), mesh, {.translation = stand.position, .rotation = stand.facing()});
        }
}

float floorAt(float z) { return 1.1f * glm::smoothstep(3.5f, -15.0f, z); }

void addStalls(Glb& glb, const Paints& paint) {
    Model ground{"stalls", {}};
    Mesh slope = grid(2, 24, [](float u, float v) {
        const float z = -15 + 18.6f * v;
        return glm::vec3(-11 + 22 * u, floorAt(z), z);
    });
    scaleUv(slope, glm::vec2(22, 18.6f) / weaveSize);
    ground.add(paint.carpet, slope);
    glb.addNode(ground);

    Model seat{"seat", {}};
    const auto soft = [&](Mesh mesh) {
        scaleUv(mesh, glm::vec2(1 / weaveSize));
        seat.add(paint.velvet, mesh);
    };
    soft(placed(roundedBox({0.50f, 0.13f, 0.48f}, 0.055f, 2), {0, 0.44f, 0}));
    soft(placed(roundedBox({0.46f, 0.54f, 0.11f}, 0.05f, 2), glm::rotate(glm::translate(glm::mat4(1), {0, 0.79f, -0.25f}), -0.16f, {1, 0, 0})));
    seat.add(paint.gilt,
             placed(roundedBox({0.54f, 0.62f, 0.05f}, 0.024f, 2), glm::rotate(glm::translate(glm::mat4(1), {0, 0.81f, -0.29f}), -0.16f, {1, 0, 0})));
    seat.add(paint.gilt, placed(bent(sphere(12, 8), [](const glm::vec3& p) { return p * glm::vec3(0.13f, 0.07f, 0.03f); }), {0, 1.13f, -0.34f}));
    for (float side : {-1.0f, 1.0f}) {
        const Station rail[] = {{{side * 0.28f, 0.72f, -0.28f}, 0.025f},
                                {{side * 0.29f, 0.68f, 0.0f}, 0.027f},
                                {{side * 0.28f, 0.62f, 0.21f}, 0.024f},
                                {{side * 0.27f, 0.38f, 0.22f}, 0.022f},
                                {{side * 0.25f, 0, 0.20f}, 0.018f}};
        seat.add(paint.gilt, limb(rail, 3, 6));
        seat.add(paint.gilt, bar({side * 0.24f, 0.4f, -0.24f}, {side * 0.25f, 0, -0.28f}, 0.022f, 6));
    }
    const int mesh = glb.addMesh(seat);
    int number = 0;
    for (int row = 0; row < 13; ++row) {
        // Rows are arcs around a point behind the camera; an aisle runs through their middle.
        const float reach = 11.0f + 1.06f * float(row);
        const glm::vec3 centre(0, 0, 12.4f);
        const float step = 0.66f / reach;
        for (int i = 0; i < 16; ++i)
            for (float side : {-1.0f, 1.0f}) {
                const float a = side * (0.75f / reach + step * (float(i) + 0.5f));
                const glm::vec3 at = centre + reach * glm::vec3(std::sin(a), 0, -std::cos(a));
                const float wide = at.z > middle ? radius : std::sqrt(std::max(radius * radius - (at.z - middle) * (at.z - middle), 0.0f));
                if (std::abs(at.x) > wide - 1.2f) continue;
                glb.addNode("seat_" + std::to_string(number++), mesh, {.translation = {at.x, floorAt(at.z), at.z}, .rotation = turnY(-glm::degrees(a))});
            }
    }
}

/// The rail before the pit, the edge of the stage, and the black house around the camera, with battens of lamps that light the hall from there.
void addStage(Glb& glb, const Paints& paint) {
    Model stage{"stage", {}};
    std::vector<glm::vec3> rail;
    for (int i = 0; i <= 24; ++i) {
        const float x = -9.95f + 19.9f * float(i) / 24;
        rail.push_back({x, 0, 2.75f + 0.0055f * x * x});
    }
    const glm::vec2 front[] = {{0.06f, 0.95f}, {0.06f, -1.4f}}, back[] = {{-0.06f, 0}, {-0.06f, 0.95f}},
                    cap[] = {{-0.11f, 0.93f}, {-0.09f, 1.0f}, {0.09f, 1.0f}, {0.11f, 0.93f}};
    const auto run = [&](int material, std::span<const glm::vec2> profile, const glm::vec2& repeat) {
        Mesh mesh = moulding(rail, profile);
        scaleUv(mesh, 1.0f / repeat);
        stage.add(material, mesh);
    };
    run(paint.wood, front, panelSize);
    run(paint.frieze, back, {friezeSize.x, 0.95f});
    run(paint.velvet, cap, glm::vec2(weaveSize));
    Mesh boards = placed(roundedBox({24, 2.5f, 14}, 0.04f), {0, -0.15f, 13.4f});
    scaleUv(boards, 1.0f / panelSize);
    stage.add(paint.wood, boards);
    Mesh pit = rectangle({-10.2f, -1.2f, 2.6f}, {20.4f, 0, 0}, {0, 0, 4.2f});
    scaleUv(pit, glm::vec2(20.4f, 4.2f) / panelSize);
    stage.add(paint.wood, pit);

    const float top = ceiling + 3;
    stage.add(paint.dark, rectangle({13, top, 20}, {-26, 0, 0}, {0, -top - 2, 0}));
    stage.add(paint.dark, rectangle({-13, top, 20}, {26, 0, 0}, {0, 0, -14}));
    for (float side : {-1.0f, 1.0f}) {
        stage.add(paint.dark, rectangle({side * 13, top, side < 0 ? 20.0f : 6.0f}, {0, 0, side * 14}, {0, -top - 2, 0}));
        // The frame of the stage closes the horseshoe.
        Mesh jamb = placed(roundedBox({3.6f, top + 2, 0.8f}, 0.1f, 2), {side * (radius + 1.45f), top / 2 - 1, 6.0f});
        scaleUv(jamb, 1.0f / friezeSize);
        stage.add(paint.frieze, jamb);
    }
    glb.addNode(stage);
    Model batten{"battens", {}};
    for (float y : {6.5f, 9.0f}) {
        batten.add(paint.iron, bar({-7.5f, y + 0.16f, 10.5f}, {7.5f, y + 0.16f, 10.5f}, 0.05f, 6));
        for (int i = 0; i < 24; ++i) batten.add(paint.flame, bulb({-7.2f + 14.4f * float(i) / 23, y, 10.5f}, 0.075f));
    }
    glb.addNode(batten);
}

/// A shallow dome over the horseshoe, and the chandelier below its middle.
void addCeiling(Glb& glb, const Paints& paint) {
    const glm::vec3 centre(0, ceiling, middle + 1.0f);
    Model dome{"ceiling", {}};
    constexpr float reach = 10.5f;
    Mesh shell = grid(96, 32, [&](float u, float v) {
        const float r = v * 1.55f * reach, a = 2 * pi * u, t = std::min(r / reach, 1.0f);
        return centre + glm::vec3(r * std::cos(a), 2.5f * (1 - t * t), r * std::sin(a));
    });
    for (Vertex& v : shell.vertices)
        v.uv = glm::clamp((glm::vec2(v.position.x, v.position.z) - glm::vec2(centre.x, centre.z)) / (2 * reach) + 0.5f, 0.004f, 0.996f);
    dome.add(paint.ceiling, shell);
    glb.addNode(dome);

    Model frame{"chandelier", {}}, lit{"chandelier_lamps", {}}, drops{"chandelier_drops", {}};
    const glm::vec2 stem[] = {{0.03f, 8.2f}, {0.05f, 3.6f}, {0.22f, 3.3f}, {0.30f, 3.0f},   {0.10f, 2.6f},  {0.16f, 2.0f}, {0.30f, 1.55f},
                              {0.14f, 1.1f}, {0.34f, 0.5f}, {0.40f, 0.2f}, {0.18f, -0.15f}, {0.09f, -0.3f}, {0, -0.45f}};
    frame.add(paint.gilt, turned(smoothCurve(stem, 3), 18));
    struct Ring {
        float radius, height;
        int arms;
    };
    for (const Ring& ring : {Ring{1.75f, 0.75f, 28}, Ring{1.25f, 1.65f, 20}, Ring{0.75f, 2.5f, 12}}) {
        std::vector<Station> hoop;
        for (int i = 0; i <= 36; ++i)
            hoop.push_back(
                {{ring.radius * 0.86f * std::sin(2 * pi * float(i) / 36), ring.height - 0.02f, ring.radius * 0.86f * std::cos(2 * pi * float(i) / 36)},
                 0.035f});
        frame.add(paint.gilt, tube(hoop, 6));
        for (int i = 0; i < ring.arms; ++i) {
            const float a = 2 * pi * float(i) / float(ring.arms);
            const auto at = [&](float r, float y) { return glm::vec3(r * std::sin(a), ring.height + y, r * std::cos(a)); };
            const Station curve[] = {{at(0.15f, 0.1f), 0.018f},
                                     {at(0.45f * ring.radius, -0.22f), 0.016f},
                                     {at(0.9f * ring.radius, -0.12f), 0.014f},
                                     {at(ring.radius, 0.12f), 0.014f}};
            frame.add(paint.gilt, limb(curve, 3, 5));
            lit.add(paint.flame, bulb(at(ring.radius, 0.22f), 0.07f));
            for (int k = 0; k < 2; ++k) {
                Mesh drop = gem(6);
                for (Vertex& v : drop.vertices)
                    v.position = v.position * glm::vec3(0.04f, 0.075f, 0.04f) + at(ring.radius * (0.93f - 0.22f * float(k)), -0.25f - 0.10f * float(k));
                drops.add(paint.crystal, faceted(drop));
            }
        }
    }
    const glm::vec3 hung = centre + glm::vec3(0, -5.6f, 0);
    for (const Model* part : {&frame, &lit, &drops}) glb.addNode(*part, {.translation = hung});
}

Glb makeOperaHall() {
    Glb glb;
    const Paints paint = addPaints(glb);
    addTiers(glb, paint);
    addColumns(glb, paint);
    addBoxes(glb, paint);
    addStalls(glb, paint);
    addStage(glb, paint);
    addCeiling(glb, paint);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeOperaHall)

}  // namespace lodestir::generate
