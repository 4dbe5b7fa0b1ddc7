// SPDX-License-Identifier: MIT
// A merry-go-round at dusk: rows of lamps that turn with it, a wheel of lamps behind, strings of lamps over wet setts. Every lamp is a light, most move.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "kit/grass.h"
#include "kit/horse.h"
#include "kit/lamps.h"
#include "kit/metals.h"
#include "kit/motion.h"
#include "kit/paving.h"
#include "kit/random.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/wood.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;
constexpr int gores = 16;                    ///< of the canopy; boards and ribs follow it
constexpr float rim = 4.7f, eaves = 3.55f;   ///< radius and height of the canopy's edge, metres
constexpr float deck = 0.52f, drum = 1.15f;  ///< height of the platform, radius of the middle
constexpr int loop = 240;                    ///< pieces of all animations, so that they repeat together: ten seconds, a turn of the carousel

/// A point of a circle around +y; angle 0 is +z, and grows towards +x.
glm::vec3 around(float radius, float height, float angle) { return {radius * std::sin(angle), height, radius * std::cos(angle)}; }

/// A thing that faces +z, carried out to the circle's `radius` at an angle.
Mesh onCircle(const Mesh& mesh, float radius, float height, float angle) {
    return placed(mesh, glm::translate(glm::rotate(glm::mat4(1), angle, glm::vec3(0, 1, 0)), glm::vec3(0, height, radius)));
}

struct Paints {
    int red, cream, gilt, brass, mirror, teal, boards, iron;
    int warm, amber, rose, mint;  ///< lamps
};

Paints addPaints(Glb& glb) {
    const auto lacquer = [&](const std::string& name, const glm::vec3& color) {
        return glb.addMaterial({.name = name, .color = color, .roughness = 0.35f, .coat = 0.8f, .coatRoughness = 0.12f});
    };
    const auto lamp = [&](const std::string& name, const glm::vec3& radiance) {
        return glb.addMaterial({.name = name, .color = glm::vec3(0), .emission = radiance});
    };
    Paints p{};
    p.red = lacquer("red", {0.50f, 0.022f, 0.020f});
    p.cream = lacquer("cream", {0.80f, 0.68f, 0.46f});
    p.teal = lacquer("teal", {0.015f, 0.16f, 0.17f});
    p.gilt = glb.addMaterial({.name = "gilt", .color = gold, .roughness = 0.28f, .metalness = 1});
    p.brass = glb.addMaterial({.name = "brass", .color = {0.83f, 0.62f, 0.30f}, .roughness = 0.15f, .metalness = 1});
    p.mirror = glb.addMaterial({.name = "mirror", .color = silver, .roughness = 0.03f, .metalness = 1});
    p.boards = glb.addMaterial(glb.dressed({.name = "deck"}, paintPanel(oak(), 31, 512)));
    p.iron = glb.addMaterial({.name = "iron", .color = glm::vec3(0.020f, 0.026f, 0.024f), .roughness = 0.4f});
    p.warm = lamp("lamp_warm", {26, 14, 5.5f});
    p.amber = lamp("lamp_amber", {26, 9.5f, 1.5f});
    p.rose = lamp("lamp_rose", {24, 3.6f, 3.2f});
    p.mint = lamp("lamp_mint", {5, 15, 10});
    return p;
}

/// Height of the roof's cloth over the radius: it hangs through a little between apex and rim.
float roof(float radius) {
    const float t = radius / rim;
    return eaves + 0.42f + 2.9f * std::pow(1 - t, 1.35f);
}

void addCanopy(Model& model, const Paints& paint) {
    for (int i = 0; i < gores; ++i) {
        const float from = tau * float(i) / gores, to = tau * float(i + 1) / gores;
        const int cloth = i % 2 ? paint.cream : paint.red;
        model.add(cloth, grid(6, 14, [&](float u, float v) {
                      const float r = 0.25f + (rim - 0.25f) * v;
                      return around(r, roof(r) + 0.05f * std::sin(std::numbers::pi_v<float> * u) * v, glm::mix(from, to, u));
                  }));
        // The ceiling below it, on ribs.
        model.add(i % 2 ? paint.cream : paint.teal, grid(3, 1, [&](float u, float v) {
                      return around(glm::mix(rim - 0.05f, drum, v), glm::mix(eaves + 0.12f, eaves + 0.42f, v), glm::mix(from, to, u));
                  }));
        model.add(paint.gilt, bar(around(drum, eaves + 0.38f, from), around(rim, eaves + 0.08f, from), 0.035f, 8));

        // Rounding boards: a painted panel in a gilt frame, a mirror in its middle, a crest over it and a swag below.
        const float middle = (from + to) / 2, width = 2 * rim * std::tan(tau / gores / 2);
        const auto board = [&](int material, const Mesh& mesh) { model.add(material, onCircle(mesh, rim, eaves + 0.28f, middle)); };
        board(paint.gilt, roundedBox({width, 0.62f, 0.06f}, 0.025f, 2));
        board(i % 2 ? paint.teal : paint.red, placed(roundedBox({width - 0.14f, 0.48f, 0.06f}, 0.02f, 2), {0, 0, 0.015f}));
        board(paint.gilt, placed(bent(sphere(24, 12), [](const glm::vec3& p) { return p * glm::vec3(0.40f, 0.20f, 0.05f); }), {0, 0, 0.03f}));
        board(paint.mirror, placed(bent(sphere(24, 12), [](const glm::vec3& p) { return p * glm::vec3(0.34f, 0.155f, 0.045f); }), {0, 0, 0.05f}));
        board(paint.gilt,
              placed(bent(sphere(20, 10), [](const glm::vec3& p) { return p * glm::vec3(0.30f * (1 - 0.25f * p.y), 0.24f, 0.04f); }), {0, 0.36f, 0}));
        for (float side : {-1.0f, 1.0f})
            board(paint.cream, placed(bent(sphere(12, 8), [](const glm::vec3& p) { return p * glm::vec3(0.10f, 0.14f, 0.03f); }), {side * 0.5f, 0.28f, 0.01f}));
        board(paint.red, grid(16, 4, [&](float u, float v) {
                  const float scallop = 0.10f + 0.14f * std::sin(std::numbers::pi_v<float> * u);
                  return glm::vec3((u - 0.5f) * width, -0.29f - v * scallop, 0.012f + 0.015f * std::sin(6 * tau * u) * v);
              }));
        std::vector<Station> fringe;
        for (int k = 0; k <= 16; ++k) {
            const float u = float(k) / 16;
            fringe.push_back({{(u - 0.5f) * width, -0.29f - 0.10f - 0.14f * std::sin(std::numbers::pi_v<float> * u), 0.02f}, 0.016f});
        }
        board(paint.gilt, tube(fringe, 6));
    }
    const glm::vec2 finial[] = {{0, 0.85f},     {0.04f, 0.75f}, {0.03f, 0.6f},  {0.16f, 0.45f}, {0.16f, 0.38f},
                                {0.06f, 0.25f}, {0.12f, 0.12f}, {0.42f, 0.02f}, {0.45f, -0.1f}};
    model.add(paint.gilt, placed(turned(smoothCurve(finial, 4), 20), glm::vec3(0, roof(0.3f), 0)));
}

/// The platform, and the drum of mirrors and painted panels that hides the engine.
void addPlatform(Model& model, const Paints& paint) {
    Mesh top = grid(96, 6, [](float u, float v) { return around(glm::mix(drum, 4.45f, v), deck, tau * u); });
    for (Vertex& v : top.vertices) v.uv = glm::vec2(v.position.x, v.position.z) / panelSize;
    model.add(paint.boards, top);
    const glm::vec2 edge[] = {{4.40f, deck + 0.002f}, {4.5f, deck + 0.002f}, {4.53f, deck - 0.02f},
                              {4.52f, deck - 0.08f},  {4.46f, deck - 0.12f}, {4.44f, deck - 0.26f}};
    model.add(paint.gilt, turned(edge, 128));
    constexpr int sides = 12;
    for (int i = 0; i < sides; ++i) {
        const float angle = tau * (float(i) + 0.5f) / sides, width = 2 * drum * std::tan(tau / sides / 2);
        const auto put = [&](int material, const Mesh& mesh, float height) { model.add(material, onCircle(mesh, drum * 0.98f, deck + height, angle)); };
        put(paint.cream, roundedBox({width, eaves - deck + 0.4f, 0.06f}, 0.01f), (eaves - deck) / 2);
        put(paint.gilt, roundedBox({width - 0.10f, 1.95f, 0.07f}, 0.02f, 2), 1.75f);
        put(i % 2 ? paint.mirror : paint.teal, placed(roundedBox({width - 0.18f, 1.85f, 0.06f}, 0.01f), {0, 0, 0.012f}), 1.75f);
        if (i % 2 == 0)
            put(paint.gilt, placed(bent(sphere(16, 10), [](const glm::vec3& p) { return p * glm::vec3(0.13f, 0.34f, 0.03f); }), {0, 0, 0.04f}), 1.75f);
        put(i % 2 ? paint.red : paint.teal, placed(roundedBox({width - 0.12f, 0.55f, 0.06f}, 0.015f), {0, 0, 0.015f}), 0.40f);
    }
}

/// All that turns and does not rise. Lamps have nodes of their own, a colour each.
void addTurning(Glb& glb, const Paints& paint, std::vector<int>& turning) {
    Model body{"carousel", {}};
    addCanopy(body, paint);
    addPlatform(body, paint);
    turning.push_back(glb.addNode(body));

    Model rows[] = {{"lamps_warm", {}}, {"lamps_amber", {}}, {"lamps_rose", {}}, {"lamps_mint", {}}};
    const int glow[] = {paint.warm, paint.amber, paint.rose, paint.mint};
    const auto lamp = [&](int color, const glm::vec3& at, float radius) { rows[color].add(glow[color], bulb(at, radius)); };
    for (int i = 0; i < gores; ++i) {
        const float corner = tau * float(i) / gores;
        for (int k = 0; k < 6; ++k) {
            // Along the boards' lower and upper edges, on the chord between corners.
            const float middle = corner + tau / gores / 2, along = (float(k) / 6 + 1.0f / 12 - 0.5f) * 2 * rim * std::tan(tau / gores / 2);
            const auto at = [&](float height) {
                return around(rim, height, middle) + along * glm::vec3(std::cos(middle), 0, -std::sin(middle)) + around(0.07f, 0, middle);
            };
            lamp(0, at(eaves - 0.005f), 0.034f);
            lamp(1, at(eaves + 0.565f), 0.034f);
        }
        lamp(2, around(rim + 0.12f, eaves + 0.70f, corner), 0.06f);
        for (int k = 0; k < 8; ++k) {  // under the ribs
            const float t = (float(k) + 0.7f) / 8.4f;
            lamp(k % 2 ? 0 : 1, around(glm::mix(drum, rim, t), glm::mix(eaves + 0.30f, eaves + 0.0f, t), corner), 0.05f);
        }
    }
    for (int i = 0; i < 12; ++i)
        for (int k = 0; k < 7; ++k) lamp(k % 3 == 1 ? 3 : 0, around(drum * 1.07f, deck + 0.85f + 0.30f * float(k), tau * float(i) / 12), 0.03f);
    for (const Model& row : rows) turning.push_back(glb.addNode(row));
}

/// Horses on poles in two rings; each rises and falls in its own time. The node stands on the axis, so that a turn carries the horse around.
void addHorses(Glb& glb, const Paints& paint) {
    const auto lacquer = [&](const std::string& name, const glm::vec3& color) {
        return glb.addMaterial({.name = name, .color = color, .roughness = 0.3f, .coat = 1, .coatRoughness = 0.05f});
    };
    const int coats[] = {lacquer("grey", {0.74f, 0.70f, 0.63f}), lacquer("black", {0.022f, 0.018f, 0.018f}), lacquer("chestnut", {0.30f, 0.085f, 0.025f}),
                         lacquer("palomino", {0.62f, 0.39f, 0.15f})};
    const int cloths[] = {lacquer("blue", {0.025f, 0.075f, 0.30f}), paint.red, paint.teal, lacquer("plum", {0.20f, 0.02f, 0.14f})};
    const int leather = lacquer("leather", {0.17f, 0.045f, 0.018f}), pale = lacquer("pale_mane", {0.82f, 0.74f, 0.58f}),
              dark = lacquer("dark_mane", {0.03f, 0.02f, 0.015f});
    std::vector<Model> breeds;
    for (int i = 0; i < 4; ++i)
        breeds.push_back(horse("horse_" + std::to_string(i), {coats[i],
                                                              i == 0 || i == 3 ? pale
                                                              : i == 1         ? paint.gilt
                                                                               : dark,
                                                              paint.gilt, leather, cloths[i], paint.gilt, dark}));

    struct Ring {
        int count;
        float radius, scale;
    };
    int number = 0;
    for (const Ring& ring : {Ring{12, 3.75f, 1.0f}, Ring{8, 2.35f, 0.86f}}) {
        const float height = 1.62f;
        std::vector<int> meshes;
        for (const Model& breed : breeds) {
            Model mounted{breed.name, {}};
            const glm::mat4 stand = glm::scale(glm::translate(glm::mat4(1), {0, height, ring.radius}), glm::vec3(ring.scale));
            for (const auto& [material, part] : breed.parts) mounted.add(material, placed(part, stand));
            meshes.push_back(glb.addMesh(mounted));
        }
        Model pole{"pole", {}};
        pole.add(paint.brass, bar({0, deck, ring.radius}, {0, eaves + 0.25f, ring.radius}, 0.026f, 12));
        const int poleMesh = glb.addMesh(pole);
        for (int i = 0; i < ring.count; ++i, ++number) {
            const float start = 360.0f * (float(i) + (ring.count == 8 ? 0.3f : 0.0f)) / float(ring.count), phase = 0.37f * float(i * 3 % 8);
            const auto turn = [&](float t) { return asVector(turnY(start + 360 * t)); };
            const int rider =
                glb.addNode("horse_" + std::to_string(number), meshes[size_t((i * 3 + (ring.count == 8 ? 1 : 0)) % 4)], {.rotation = turnY(start)});
            animate(glb, rider, Motion::rotation, loop, turn);
            animate(glb, rider, Motion::translation, loop, [&](float t) { return glm::vec4(0, 0.22f * std::sin(tau * (3 * t + phase)), 0, 0); });
            animate(glb, glb.addNode("pole_" + std::to_string(number), poleMesh, {.rotation = turnY(start)}), Motion::rotation, loop, turn);
        }
    }
}

/// The wheel behind: two rims and their spokes set with lamps, and gondolas that hang level as it turns.
void addWheel(Glb& glb, const Paints& paint) {
    const glm::vec3 hub(-20.5f, 7.8f, -15);
    constexpr float radius = 6.6f;
    constexpr int spokes = 16;
    Model frame{"wheel", {}}, lit{"wheel_lamps", {}};
    const auto at = [&](float r, float angle, float z) { return glm::vec3(r * std::cos(angle), r * std::sin(angle), z); };
    for (float z : {-0.55f, 0.55f})
        for (float r : {radius, radius - 0.8f})
            for (int i = 0; i < 48; ++i) frame.add(paint.iron, bar(at(r, tau * float(i) / 48, z), at(r, tau * float(i + 1) / 48, z), 0.05f, 5));
    for (int i = 0; i < spokes; ++i) {
        const float angle = tau * float(i) / spokes;
        for (float z : {-0.55f, 0.55f}) frame.add(paint.iron, bar(at(0.2f, angle, z), at(radius, angle, z), 0.04f, 5));
        frame.add(paint.iron, bar(at(radius, angle, -0.55f), at(radius, angle, 0.55f), 0.04f, 5));
        for (int k = 0; k < 6; ++k) lit.add(i % 2 ? paint.amber : paint.rose, bulb(at(1.2f + 0.9f * float(k), angle, 0.66f), 0.08f));
        for (int k = 0; k < 4; ++k) lit.add(k % 2 ? paint.warm : paint.mint, bulb(at(radius, angle + tau / spokes * (float(k) + 0.5f) / 4, 0.66f), 0.085f));
    }
    const auto turn = [&](float t) { return asVector(glm::angleAxis(tau * t / spokes * 4, glm::vec3(0, 0, 1))); };
    const glm::quat tip = turnY(22);
    for (Model* part : {&frame, &lit})
        animate(glb, glb.addNode(*part, {.translation = hub, .rotation = tip}), Motion::rotation, loop, [&](float t) {
            const glm::vec4 q = turn(t);
            return asVector(tip * glm::quat(q.w, q.x, q.y, q.z));
        });

    Model car{"gondola", {}};
    car.add(paint.red, placed(roundedBox({0.95f, 0.55f, 0.85f}, 0.12f, 3), {0, -1.05f, 0}));
    car.add(paint.cream, placed(roundedBox({1.0f, 0.10f, 0.9f}, 0.05f, 2), {0, -0.25f, 0}));
    for (float x : {-0.4f, 0.4f}) car.add(paint.iron, bar({x, -0.8f, 0}, {x * 0.6f, 0, 0}, 0.03f, 5));
    const int gondola = glb.addMesh(car);
    for (int i = 0; i < spokes; ++i) {
        const auto place = [&](float t) { return hub + tip * at(radius, tau * (float(i) / spokes + t / spokes * 4), 0); };
        const int node = glb.addNode("gondola_" + std::to_string(i), gondola, {.translation = place(0), .rotation = tip});
        animate(glb, node, Motion::translation, loop, [&](float t) { return glm::vec4(place(t), 0); });
    }
    Model stand{"wheel_stand", {}};
    for (float side : {-1.0f, 1.0f})
        for (float z : {-0.9f, 0.9f}) stand.add(paint.iron, bar({0, 0, z * 0.8f}, {side * 3.6f, -9.1f, z * 1.6f}, 0.13f, 8));
    stand.add(paint.iron, bar({0, 0, -1}, {0, 0, 1}, 0.3f, 12));
    glb.addNode(stand, {.translation = hub, .rotation = tip});
}

/// What stands still: the square, steps, street lamps, strings of lamps, trees.
void addSquare(Glb& glb, const Paints& paint) {
    Model ground{"square", {}};
    Mesh plain = rectangle({-45, 0, -60}, {90, 0, 0}, {0, 0, 85});
    scaleUv(plain, glm::vec2(90, 85) / settsSize);
    ground.add(glb.addMaterial(glb.dressed({.name = "wet_setts"}, paintWetSetts(3, 1024))), plain);
    glb.addNode(ground);

    Model step{"steps", {}};
    const glm::vec2 profile[] = {{4.3f, 0.24f}, {4.85f, 0.24f}, {4.89f, 0.22f}, {4.9f, 0.18f}, {4.9f, 0}};
    step.add(paint.red, turned(profile, 128));
    const glm::vec2 nosing[] = {{4.86f, 0.245f}, {4.92f, 0.24f}, {4.92f, 0.20f}};
    step.add(paint.gilt, turned(nosing, 128));
    const glm::vec2 skirt[] = {{4.35f, deck - 0.1f}, {4.35f, 0.2f}};
    step.add(paint.iron, turned(skirt, 96));
    glb.addNode(step);

    const int lamp = glb.addMesh(streetLamp("street_lamp", paint.iron, paint.warm, 3.9f, true));
    const glm::vec3 posts[] = {{-7.4f, 0, 3.2f}, {7.6f, 0, 2.2f}, {8.6f, 0, -6.5f}, {-8.2f, 0, -6.0f}, {0.6f, 0, -11.5f}};
    for (int i = 0; i < 5; ++i) glb.addNode("street_lamp_" + std::to_string(i), lamp, {.translation = posts[i], .rotation = turnY(25 + 50 * float(i))});
    Model strings{"festoons", {}};
    const glm::vec3 top(0, 3.75f, 0);
    const int order[] = {0, 3, 4, 2, 1};
    for (int i = 0; i < 4; ++i)
        addFestoon(strings, paint.iron, i % 2 ? paint.amber : paint.warm, {posts[order[i]] + top, posts[order[i + 1]] + top, 0.9f, 16, 0.045f});
    glb.addNode(strings);

    Model leaves{"tree", {}};
    leaves.add(glb.addMaterial({.name = "leaves", .roughness = 0.85f, .doubleSided = true}), shrub(77, 3000));
    const int bush = glb.addMesh(leaves);
    Random random(5);
    for (int i = 0; i < 56; ++i) {
        const float angle = random.between(2.0f, 4.8f), r = random.between(20, 44), size = random.between(3.5f, 7);
        const glm::vec3 at = around(r, -0.08f * size, angle);
        glb.addNode("tree_" + std::to_string(i), bush, {.translation = at, .rotation = turnY(random.between(0, 360)), .scale = glm::vec3(size)});
    }
}

Glb makeCarousel() {
    Glb glb;
    const Paints paint = addPaints(glb);
    std::vector<int> turning;
    addTurning(glb, paint, turning);
    for (int node : turning) animate(glb, node, Motion::rotation, loop, [](float t) { return asVector(turnY(360 * t)); });
    addHorses(glb, paint);
    addWheel(glb, paint);
    addSquare(glb, paint);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeCarousel)

}  // namespace lodestir::generate
