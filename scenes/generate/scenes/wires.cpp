// SPDX-License-Identifier: MIT
// A garden behind iron bars, strained wires and a net. The camera walks along them: at 480x270 they are from half a pixel to four pixels wide.
#include <cmath>
#include <string>

#include "kit/cottage.h"
#include "kit/grass.h"
#include "kit/metals.h"
#include "kit/random.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/spline.h"
#include "kit/tree.h"
#include "kit/watercolour.h"

namespace lodestir::generate {

namespace {

/// Metres that a pixel spans at the fence, for the camera of scenes/wires.json at 480x270.
constexpr float pixel = 0.00594f;
constexpr float top = 1.9f, foot = 0.12f;  ///< of what stands between the rails
constexpr float field = 1.2f;              ///< width of a field, from post to post

/// Something of one thickness, named after it.
struct Gauge {
    const char* name;
    float pixels;
    float radius() const { return 0.5f * pixels * pixel; }
};

void addBars(Glb& glb, int iron, const Gauge& gauge, float left, float spacing) {
    Model bars{gauge.name, {}};
    const int count = int(std::lround(field / spacing));
    for (int i = 1; i < count; ++i) {
        const float x = left + field * float(i) / float(count);
        bars.add(iron, bar({x, foot, 0}, {x, top, 0}, gauge.radius(), 8));
    }
    glb.addNode(bars);
}

/// Wires between two posts, hanging through by a millimetre or two.
void addWires(Glb& glb, int steel, const Gauge& gauge, float left, float first, float spacing, int count) {
    Model wires{gauge.name, {}};
    for (int i = 0; i < count; ++i) {
        const float y = first + spacing * float(i);
        std::vector<Station> stations;
        for (const glm::vec3& p : cord({left, y, 0}, {left + field, y, 0}, 0.002f, 6)) stations.push_back({p, gauge.radius()});
        wires.add(steel, tube(stations, 6));
    }
    glb.addNode(wires);
}

/// A square-meshed net, slack between its ropes.
void addNet(Glb& glb, int twine, const Gauge& gauge, float left, float mesh) {
    Model net{gauge.name, {}};
    const int across = int(std::lround(field / mesh)), up = int(std::lround((top - foot) / mesh));
    const auto knot = [&](float u, float v) {
        const float slack = 4 * u * (1 - u);
        return glm::vec3(left + field * u, glm::mix(foot, top, v) - 0.05f * slack * v, 0.02f * slack * std::sin(9 * u + 4 * v));
    };
    const auto string = [&](auto&& at, int knots) {
        std::vector<Station> stations;
        for (int i = 0; i <= knots; ++i) stations.push_back({at(float(i) / float(knots)), gauge.radius()});
        net.add(twine, tube(stations, 5));
    };
    for (int i = 1; i < across; ++i) string([&](float t) { return knot(float(i) / float(across), t); }, up / 2);
    for (int i = 0; i <= up; ++i) string([&](float t) { return knot(t, float(i) / float(up)); }, across);
    glb.addNode(net);
}

void addFence(Glb& glb) {
    const int iron = glb.addMaterial({.name = "iron", .color = glm::vec3(0.045f), .roughness = 0.35f, .metalness = 0.6f}),
              steel = glb.addMaterial({.name = "steel", .color = generate::steel, .roughness = 0.3f, .metalness = 1}),
              twine = glb.addMaterial({.name = "twine", .color = {0.72f, 0.62f, 0.44f}, .ior = 1});
    Model frame{"frame", {}};
    for (int i = 0; i <= 4; ++i) {
        const float x = -2 * field + field * float(i);
        frame.add(iron, placed(roundedBox({0.07f, top + 0.25f, 0.07f}, 0.012f, 1), {x, (top + 0.25f) / 2, 0}));
        frame.add(iron, placed(sphere(16, 8), glm::mat4(0.055f, 0, 0, 0, 0, 0.055f, 0, 0, 0, 0, 0.055f, 0, x, top + 0.29f, 0, 1)));
    }
    for (float y : {foot, top}) frame.add(iron, placed(roundedBox({4 * field, 0.04f, 0.03f}, 0.008f, 1), {0, y, 0}));
    glb.addNode(frame);

    addBars(glb, iron, {"bars_4_pixels", 4}, -2 * field, 0.12f);
    addWires(glb, steel, {"wires_2_pixels", 2}, -field, foot + 0.06f, 0.15f, 12);
    addWires(glb, steel, {"wires_1_pixel", 1}, -field, foot + 0.11f, 0.15f, 12);
    addWires(glb, steel, {"wires_half_a_pixel", 0.5f}, -field, foot + 0.16f, 0.15f, 12);
    addNet(glb, twine, {"net_1_pixel", 1}, 0, 0.05f);
    addBars(glb, iron, {"bars_2_pixels", 2}, field, 0.06f);
}

void addGarden(Glb& glb) {
    const Material paper = glb.dressed({.name = "wash"}, paintWash(3, 512)), tiles = glb.dressed({.name = "roof"}, paintRoof(4, 512));
    const auto paint = [&](const Material& picture, const std::string& name, const glm::vec3& color) { return glb.addMaterial(wash(picture, name, color)); };
    const CottagePaints paints{paint(paper, "rose", {0.86f, 0.58f, 0.46f}),  paint(tiles, "slate", {0.30f, 0.32f, 0.40f}),
                               paint(paper, "trim", {0.88f, 0.85f, 0.78f}),  paint(paper, "cobalt", {0.10f, 0.22f, 0.52f}),
                               paint(paper, "pane", {0.075f, 0.11f, 0.17f}), paint(paper, "brick", {0.52f, 0.26f, 0.17f})};
    glb.addNode(cottage("house", paints, {6.4f, 2.9f, 4.6f}), {.translation = {-1.6f, 0, -11}, .rotation = turnY(24)});

    Model lawn{"lawn", {}};
    Mesh ground = grid(24, 24, [](float u, float v) { return glm::vec3(-45 + 90 * u, 0, -75 + 90 * v); });
    scaleUv(ground, glm::vec2(90 / washSize));
    lawn.add(paint(paper, "lawn", {0.34f, 0.46f, 0.13f}), ground);
    glb.addNode(lawn);
    Model path{"path", {}};
    Mesh way = grid(4, 30, [](float u, float v) {
        const float z = -0.4f - 8.6f * v;
        return glm::vec3(0.75f - 1.4f * v + 0.5f * std::sin(4 * v) + (u - 0.5f) * 1.1f, 0.012f, z);
    });
    scaleUv(way, glm::vec2(1.1f, 9) / washSize);
    computeNormals(way, 180);
    path.add(paint(paper, "gravel", {0.80f, 0.70f, 0.54f}), way);
    glb.addNode(path);

    const auto add = [&, dabs = glb.addMaterial(dabs())](const std::string& name, const Mesh& mesh) { return glb.addMesh(name, mesh, dabs); };
    const int cherry = add("cherry", tree(4, generate::cherry(4.4f, 2.0f, 1800, 0.16f))),
              linden = add("linden", tree(1, {}));
    glb.addNode("cherry", cherry, {.translation = {3.0f, 0, -7.6f}});
    const glm::vec3 lindens[] = {{-8.5f, 0, -14}, {6.5f, 0, -14.5f}, {9.5f, 0, -11}, {-12, 0, -19}, {2.2f, 0, -21}, {13, 0, -22}, {-4.8f, 0, -24}};
    for (int i = 0; i < int(std::size(lindens)); ++i)
        glb.addNode("linden_" + std::to_string(i), linden,
                    {.translation = lindens[i], .rotation = turnY(70.0f * float(i)), .scale = glm::vec3(1 + 0.1f * float(i % 3))});
    const auto bed = [&](const Flower& flower, int count) { return add(flower.name, flowerPatch(flower, count, 0.7f)); };
    const int patches[] = {bed(poppies, 34), bed(cornflowers, 34), bed(buttercups, 38)};
    const int grass = add("grass", grassTuft(21, {160, 0.22f, 0.5f, 0.12f}));
    Random random(5);
    for (int i = 0; i < 90; ++i) {
        const float z = random.between(-9.5f, -0.9f), x = random.between(-5.5f, 5.5f), turn = random.between(0, 360), scale = random.between(0.7f, 1.2f);
        const float v = (-0.4f - z) / 8.6f;
        if (std::abs(x - (0.75f - 1.4f * v + 0.5f * std::sin(4 * v))) < 1.0f) continue;
        const bool isFlower = random.next() < 0.55f;
        glb.addNode((isFlower ? "flowers_" : "grass_") + std::to_string(i), isFlower ? patches[random.below(3)] : grass,
                    {.translation = {x, 0, z}, .rotation = turnY(turn), .scale = glm::vec3(scale)});
    }
}

Glb makeWires() {
    Glb glb;
    addFence(glb);
    addGarden(glb);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeWires)

}  // namespace lodestir::generate
