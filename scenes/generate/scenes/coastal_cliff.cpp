// SPDX-License-Identifier: MIT
// A coast in the evening: cliffs of layered rock with a lighthouse on the headland, stacks in the surf, a low sun over the sea.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kit/cliff.h"
#include "kit/cottage.h"
#include "kit/grass.h"
#include "kit/noise.h"
#include "kit/random.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/stone.h"
#include "kit/water.h"

namespace lodestir::generate {

namespace {

constexpr glm::vec2 headland(-9, -148);  ///< where the lighthouse stands

Model lighthouse(Glb& glb) {
    const int white = glb.addMaterial({.name = "whitewash", .color = {0.78f, 0.76f, 0.71f}, .roughness = 0.8f}),
              red = glb.addMaterial({.name = "red_paint", .color = {0.52f, 0.05f, 0.035f}, .roughness = 0.5f}),
              iron = glb.addMaterial({.name = "iron", .color = {0.05f, 0.05f, 0.055f}, .roughness = 0.5f}),
              pane = glb.addMaterial({.name = "pane", .color = {0.10f, 0.13f, 0.15f}, .roughness = 0.06f});
    Model model{"lighthouse", {}};
    const auto ring = [&](int material, std::vector<glm::vec2> profile) { model.add(material, turned(profile, 40)); };
    const auto girth = [](float y) { return 2.6f - 0.95f * std::pow(y / 16, 0.8f); };
    const float bands[] = {0, 5.2f, 8.6f, 12.0f, 15.6f};
    for (int i = 0; i < 4; ++i) ring(i % 2 ? red : white, {{girth(bands[i + 1]), bands[i + 1]}, {girth(bands[i]), bands[i]}});
    ring(white, {{2.9f, 0.5f}, {3.0f, 0.4f}, {3.0f, -2}});
    ring(iron, {{0, 15.9f}, {2.35f, 15.9f}, {2.4f, 15.8f}, {2.3f, 15.6f}, {1.6f, 15.2f}});
    for (int i = 0; i < 16; ++i) {
        const float a = 6.2831853f * float(i) / 16, b = 6.2831853f * float(i + 1) / 16;
        const glm::vec3 foot(2.25f * std::cos(a), 15.9f, 2.25f * std::sin(a)), next(2.25f * std::cos(b), 15.9f, 2.25f * std::sin(b));
        model.add(iron, bar(foot, foot + glm::vec3(0, 1.1f, 0), 0.035f));
        for (float up : {0.55f, 1.1f}) model.add(iron, bar(foot + glm::vec3(0, up, 0), next + glm::vec3(0, up, 0), 0.028f));
    }
    ring(pane, {{1.25f, 18.1f}, {1.25f, 16.3f}});
    ring(white, {{1.3f, 16.4f}, {1.32f, 15.9f}});
    for (int i = 0; i < 10; ++i) {
        const float a = 6.2831853f * float(i) / 10;
        const glm::vec3 foot(1.27f * std::cos(a), 16.3f, 1.27f * std::sin(a));
        model.add(iron, bar(foot, foot + glm::vec3(0, 1.85f, 0), 0.04f));
    }
    ring(red, {{0.02f, 19.7f}, {0.12f, 19.6f}, {0.16f, 19.4f}, {0.5f, 19.1f}, {1.1f, 18.5f}, {1.45f, 18.15f}, {1.42f, 18.05f}, {1.2f, 18.05f}});
    return model;
}

/// Stacks and boulders of two shapes, in the surf.
void addStacks(Glb& glb, const Cliff& cliff) {
    const auto shape = [&](const char* name, uint32_t seed, const StoneForm& form, int cells) {
        const Stone stone(seed, form);
        const Mesh mesh = stone.mesh(cells);
        return glb.addMesh(name, mesh, glb.addMaterial(glb.dressed({.name = name}, stone.bake(mesh, 256))));
    };
    const int stack = shape("stack", 61, {.size = {4.2f, 11, 3.6f}, .facets = 22, .sharpness = 20, .relief = 1.5f}, 52),
              boulder = shape("boulder", 62, {.size = {1, 0.8f, 0.9f}, .facets = 14, .sharpness = 14, .relief = 1.1f}, 20);
    struct Stand {
        glm::vec3 at;
        float turn;
        glm::vec3 scale;
    };
    const Stand stands[] = {{{-25, 3.5f, -92}, 20, {1.1f, 1.2f, 1.1f}},   {{-33, 0.5f, -108}, 140, {0.7f, 0.75f, 0.75f}},
                            {{-50, 4.5f, -150}, 250, {1.5f, 1.5f, 1.4f}}, {{-64, -1, -170}, 80, {0.9f, 0.8f, 1}},
                            {{-9, -5.5f, -52}, 310, {0.6f, 0.8f, 0.6f}},  {{-40, -6.5f, -76}, 10, {0.6f, 0.8f, 0.6f}}};
    int number = 0;
    for (const Stand& s : stands) glb.addNode("stack_" + std::to_string(number++), stack, {.translation = s.at, .rotation = turnY(s.turn), .scale = s.scale});
    Random random(12);
    for (int i = 0; i < 240; ++i) {
        const float z = random.between(25, -230), out = 5 + 5 * std::abs(random.bell()), large = 0.5f * std::pow(5.0f, std::pow(random.next(), 1.8f));
        glb.addNode("boulder_" + std::to_string(i), boulder,
                    {.translation = {cliff.edge(z) - out, random.between(-0.6f, 0.7f) - 0.12f * (out - 5), z},
                     .rotation = turnY(random.between(0, 360)),
                     .scale = large * glm::vec3(1, random.between(0.7f, 1.2f), random.between(0.8f, 1.2f))});
    }
}

/// The bay, coloured by how deep it is, with foam where it breaks; a flat sheet goes on to the horizon.
void addSea(Glb& glb, const Cliff& cliff) {
    constexpr float rippled = 16;  ///< metres
    const Noise ripple{78, {16, 16, 0}};
    const Textures ripples = paint({.width = 512, .height = 512, .metres = glm::vec2(rippled)}, [&](const glm::vec2& p) {
        return Surface{.color = glm::vec3(1), .height = 0.09f * ripple.fractal(glm::vec3(p / rippled * 16.0f, 0.5f), 5, 0.55f)};
    });
    Material sea{.name = "sea", .roughness = 0.16f, .ior = 1.333f};
    sea.normalPicture = glb.addPicture("sea_normal", ripples.normal);
    const int water = glb.addMaterial(sea), open = glb.addMaterial({.name = "open_sea", .color = {0.008f, 0.03f, 0.04f}, .roughness = 0.22f, .ior = 1.333f});
    Mesh bay = inTiles(waterSheet({-190, -330}, {55, 40}, 1.15f, {.length = 13, .height = 0.26f, .heading = 0.35f, .seed = 4}), rippled);
    const Noise noise{77};
    for (Vertex& v : bay.vertices) {
        const glm::vec3 p = v.position;
        const float away = std::max(cliff.edge(p.z) - 7 - p.x, 0.0f), lace = noise.ridged(glm::vec3(p.x, 0.5f, p.z) * 0.11f, 3);
        const float foam = glm::smoothstep(0.25f, 0.6f, lace + 0.75f * std::exp(-away / 5) - 0.45f - 0.018f * away);
        v.color = glm::mix(glm::vec3(0.008f, 0.03f, 0.04f), glm::vec3(0.03f, 0.11f, 0.105f), std::exp(-away / 18));
        v.color = glm::mix(v.color, glm::vec3(0.62f, 0.65f, 0.64f), foam);
    }
    bay.hasColors = true;
    Model model{"sea", {}};
    model.add(water, bay);
    model.add(open, rectangle({-6000, -0.5f, -6000}, {12000, 0, 0}, {0, 0, 12000}));
    glb.addNode(model);
}

void addPlants(Glb& glb, const Cliff& cliff) {
    const int blade = glb.addMaterial({.name = "grass", .roughness = 0.8f, .doubleSided = true});
    const int bushes[] = {glb.addMesh("gorse_0", shrub(620, 1500), blade), glb.addMesh("gorse_1", shrub(621, 1200), blade)};
    Random random(31);
    for (int i = 0; i < 420; ++i) {
        const float z = random.between(20, -240), inland = 0.5f + 26 * std::pow(random.next(), 1.5f), x = cliff.edge(z) + inland;
        if (glm::distance(glm::vec2(x, z), headland) < 5) continue;
        const float size = random.between(0.9f, 2.6f);
        glb.addNode("gorse_" + std::to_string(i), bushes[i % 2],
                    {.translation = {x, cliff.meadow({x, z}) - 0.1f, z}, .rotation = turnY(random.between(0, 360)), .scale = {size, 0.7f * size, size}});
    }
}

Glb makeCoastalCliff() {
    Glb glb;
    const Cliff cliff(9);
    glb.addNode(cliff.model(glb, "cliff"));
    addStacks(glb, cliff);
    addSea(glb, cliff);
    addPlants(glb, cliff);
    const float ground = cliff.meadow(headland);
    glb.addNode(lighthouse(glb), {.translation = {headland.x, ground - 0.3f, headland.y}});
    const auto paint = [&](const char* name, const glm::vec3& color) { return glb.addMaterial({.name = name, .color = color, .roughness = 0.85f}); };
    const CottagePaints paints{paint("cottage_wall", {0.74f, 0.71f, 0.65f}), paint("cottage_roof", {0.16f, 0.15f, 0.16f}),
                               paint("cottage_trim", {0.5f, 0.06f, 0.04f}),  paint("cottage_shutter", {0.5f, 0.06f, 0.04f}),
                               paint("cottage_pane", {0.05f, 0.06f, 0.07f}), paint("cottage_chimney", {0.35f, 0.22f, 0.16f})};
    const glm::vec2 yard = headland + glm::vec2(12, 5);
    glb.addNode(cottage("cottage", paints, {8, 3, 5}), {.translation = {yard.x, cliff.meadow(yard) - 0.2f, yard.y}, .rotation = turnY(-50)});
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeCoastalCliff, "--levels 3 --ratio 4 --mesh cliff --mesh stack")

}  // namespace lodestir::generate
