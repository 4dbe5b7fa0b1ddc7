// SPDX-License-Identifier: MIT
// A field of 3,840 beasts on dark polished stone: one model of eight levels, from a metre away to a hundred.
#include <cmath>
#include <string>

#include "kit/creature.h"
#include "kit/marble.h"
#include "kit/noise.h"
#include "kit/random.h"
#include "kit/scene.h"
#include "kit/shapes.h"

namespace lodestir::generate {

namespace {

constexpr int columns = 64, rows = 60;
constexpr float spacing = 2;  ///< metres: tails and claws of neighbours don't meet
constexpr float halfGround = 150;
constexpr float tileScale = 2;  ///< tiles of 1.6 m, so that they are still seen from above

void addCreatures(Glb& glb) {
    const int beast = glb.addMesh(creature(glb, "creature", 0.0064f));
    Random random(17);
    for (int i = 0; i < columns * rows; ++i) {
        const glm::vec2 cell(float(i % columns) - 0.5f * (columns - 1), float(i / columns) - 0.5f * (rows - 1));
        const glm::vec2 xz = spacing * (cell + 0.2f * glm::vec2(random.between(-1, 1), random.between(-1, 1)));
        glb.addNode("creature_" + std::to_string(i), beast,
                    {.translation = {xz.x, 0, xz.y}, .rotation = turnY(random.between(0, 360)), .scale = glm::vec3(random.between(0.8f, 1.15f))});
    }
}

Mesh ground() {
    const Noise noise{23};
    Mesh mesh = grid(160, 160, [](float u, float v) { return glm::vec3(2 * u - 1, 0, 2 * v - 1) * halfGround; });
    scaleUv(mesh, glm::vec2(2 * halfGround / (tileScale * marbleFloorSize)));
    for (Vertex& v : mesh.vertices) v.color = glm::vec3(0.75f + 0.25f * noise.fractal(v.position * 0.06f, 4));  // or the picture's repetition would show
    mesh.hasColors = true;
    return mesh;
}

Glb makeCreatures() {
    Glb glb;
    addCreatures(glb);
    const Marble slate{{0.046f, 0.046f, 0.048f}, {0.13f, 0.125f, 0.12f}, 0.20f}, basalt{{0.022f, 0.022f, 0.023f}, {0.09f, 0.085f, 0.08f}, 0.16f};
    Model floor{"ground", {}};
    floor.add(glb.addMaterial(glb.dressed({.name = "ground"}, paintMarbleFloor(slate, basalt, 31, 1024))), ground());
    glb.addNode(floor);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeCreatures, "--levels 8 --mesh creature")

}  // namespace lodestir::generate
