// SPDX-License-Identifier: MIT
// A stove of glazed tiles that all wear one chart: a point of the picture is more than a hundred points of the stove.
#include <cmath>

#include "kit/backdrop.h"
#include "kit/masonry.h"
#include "kit/metals.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/tableware.h"
#include "kit/teapot.h"
#include "kit/wood.h"

namespace lodestir::generate {

namespace {

constexpr int cells = 12;       ///< of a tile
constexpr float side = 0.165f;  ///< of a tile, metres

/// A tile as it is pressed: a round dish with a boss in a flat square. `p` in [-1, 1]^2; shares of what it is made of, and its height in metres.
struct Pressed {
    float height = 0, dish = 0, boss = 0, rim = 0;
};

Pressed pressed(const glm::vec2& p) {
    const float r = glm::length(p);
    Pressed tile;
    tile.dish = 1 - glm::smoothstep(0.70f, 0.80f, r);
    tile.rim = std::exp(-(r - 0.78f) * (r - 0.78f) / 0.004f);
    tile.boss = glm::smoothstep(0.30f, 0.10f, r);
    tile.height = -0.022f * tile.dish * (1 - 0.55f * r * r) + 0.006f * tile.rim + 0.020f * tile.boss;
    const glm::vec2 away = glm::smoothstep(glm::vec2(0), glm::vec2(0.07f), glm::vec2(1) - glm::abs(p));  // rounded edges
    tile.height += 0.006f * std::min(away.x, away.y);
    return tile;
}

Textures paintTile() {
    return paint({.width = 512, .height = 512, .repeats = false, .smooth = true}, [](const glm::vec2& m) {
        const glm::vec2 p = 2.0f * m - 1.0f;
        const Pressed tile = pressed(p);
        const float r = glm::length(p), a = std::atan2(p.y, p.x), joint = glm::smoothstep(0.965f, 0.985f, std::max(std::abs(p.x), std::abs(p.y)));
        const float petals = glm::smoothstep(0.04f, -0.04f, r - 0.62f * std::pow(std::abs(std::cos(4 * a)), 0.6f)) * tile.dish * (1 - tile.boss);
        Surface s;
        s.color = glm::mix(glm::vec3(0.05f, 0.20f, 0.13f), glm::vec3(0.015f, 0.085f, 0.06f), tile.dish);
        s.color = glm::mix(s.color, glm::vec3(0.62f, 0.55f, 0.36f), petals);
        s.color = glm::mix(s.color, glm::vec3(0.55f, 0.24f, 0.06f), std::max(tile.boss, 0.8f * tile.rim));
        s.color = glm::mix(s.color, glm::vec3(0.45f, 0.42f, 0.36f), joint);
        s.roughness = glm::mix(0.16f, 0.9f, joint);
        return s;
    });
}

/// A wall of tiles from its lower left corner, facing along cross(right, up).
void addTiles(Mesh& mesh, const glm::vec3& corner, const glm::vec3& right, int across, int up) {
    const glm::vec3 y(0, 1, 0), out = glm::cross(right, y);
    for (int row = 0; row < up; ++row)
        for (int column = 0; column < across; ++column)
            append(mesh, grid(cells, cells, [&](float u, float v) {
                       const glm::vec2 p(2 * u - 1, 1 - 2 * v);
                       return corner + side * ((float(column) + u) * right + (float(row) + 1 - v) * y) + pressed(p).height * out;
                   }));
}

Glb makeStove() {
    Glb glb;
    constexpr int wide = 5, deep = 3, high = 8;
    constexpr float width = wide * side, depth = deep * side, height = high * side, base = 0.24f;
    Mesh tiles;
    addTiles(tiles, {-width / 2, base, depth / 2}, {1, 0, 0}, wide, high);
    addTiles(tiles, {width / 2, base, depth / 2}, {0, 0, -1}, deep, high);
    addTiles(tiles, {-width / 2, base, -depth / 2}, {0, 0, 1}, deep, high);
    computeNormals(tiles, 50);
    Model stove{"stove", {}};
    stove.add(glb.addMaterial(glb.dressed({.name = "glaze"}, paintTile())), tiles);
    glb.addNode(stove);

    // What holds the tiles: a plinth, a cornice, and the feet.
    const int clay = glb.addMaterial({.name = "cornice", .color = {0.035f, 0.13f, 0.085f}, .roughness = 0.2f}),
              iron = glb.addMaterial({.name = "iron", .color = glm::vec3(0.04f), .roughness = 0.4f, .metalness = 0.7f}),
              brass = glb.addMaterial({.name = "copper", .color = copper, .roughness = 0.16f, .metalness = 1}),
              glaze = glb.addMaterial({.name = "vase", .color = {0.05f, 0.11f, 0.30f}, .roughness = 0.12f});
    Model body{"body", {}};
    const auto ledge = [&](float y, float thick, float over) {
        body.add(clay, placed(roundedBox({width + 2 * over, thick, depth + 2 * over}, thick * 0.4f, 3), {0, y, 0}));
    };
    ledge(base - 0.04f, 0.08f, 0.05f), ledge(base + height + 0.03f, 0.06f, 0.035f), ledge(base + height + 0.085f, 0.05f, 0.075f);
    for (float x : {-0.42f, 0.42f})
        for (float z : {-0.4f, 0.4f}) body.add(iron, placed(roundedBox({0.07f, base - 0.08f, 0.07f}, 0.02f, 2), {x * width, (base - 0.08f) / 2, z * depth}));
    glb.addNode(body);
    const float shelf = base + height + 0.11f;
    glb.addNode(teapot("kettle", brass, 0.24f), {.translation = {-0.16f, shelf, 0.02f}, .rotation = turnY(-25)});
    glb.addNode(vase("vase", glaze, 0.30f, 0.075f), {.translation = {0.24f, shelf, -0.05f}});

    Model floor{"floor", {}};
    Mesh boards = grid(1, 1, [](float u, float v) { return glm::vec3(-4 + 8 * u, 0, -1.2f + 6 * v); });
    scaleUv(boards, glm::vec2(8, 6) / herringboneSize);
    floor.add(glb.addMaterial(glb.dressed({.name = "herringbone"}, paintHerringbone(oak(), 6, 1024))), boards);
    glb.addNode(floor);
    Model wall{"wall", {}};
    Mesh plaster = rectangle({-4, 3.4f, -0.62f}, {8, 0, 0}, {0, -3.4f, 0});
    scaleUv(plaster, glm::vec2(8, 3.4f) / plasterSize);
    wall.add(glb.addMaterial(glb.dressed({.name = "plaster"}, paintPlaster({0.66f, 0.50f, 0.34f}, 4, 512))), plaster);
    glb.addNode(wall);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeStove, "--levels 3 --ratio 4 --mesh stove")

}  // namespace lodestir::generate
