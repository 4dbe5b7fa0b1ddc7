// SPDX-License-Identifier: MIT
// A marble mourner, life-size, in triangles of a millimetre: what a scanner makes of a statue, twelve million of them. It stands on a floor before a wall.
#include "kit/glb.h"
#include "kit/isosurface.h"
#include "kit/marble.h"
#include "kit/mourner.h"
#include "kit/scene.h"
#include "kit/shapes.h"

namespace lodestir::generate {

namespace {

constexpr float step = 0.0011f;  ///< metres

/// A rectangle through its upper-left corner, with a picture that repeats after `repeat` metres.
Mesh slab(const glm::vec3& corner, const glm::vec3& right, const glm::vec3& down, float repeat) {
    Mesh mesh = rectangle(corner, right, down);
    scaleUv(mesh, glm::vec2(glm::length(right), glm::length(down)) / repeat);
    return mesh;
}

Glb makeStatue() {
    Glb glb;
    const Mourner mourner;
    const Mesh mesh = isosurface([&](const glm::vec3& p) { return mourner.distance(p); }, Mourner::low, Mourner::high, step);
    const int marble = glb.addMaterial({.name = "marble", .color = {0.80f, 0.77f, 0.71f}, .roughness = 0.5f});
    glb.addNode("statue", glb.addMesh("statue", mesh, marble));

    Model floor{"floor", {}}, wall{"wall", {}};
    floor.add(glb.addMaterial(glb.dressed({.name = "flagstones"}, paintAshlar({0.33f, 0.31f, 0.29f}, 7, 640))),
              slab({-8, 0, -1.1f}, {16, 0, 0}, {0, 0, 9.1f}, ashlarSize));
    wall.add(glb.addMaterial(glb.dressed({.name = "limestone"}, paintAshlar({0.60f, 0.52f, 0.41f}, 3, 640))),
             slab({-8, 7.2f, -1.1f}, {16, 0, 0}, {0, -7.2f, 0}, ashlarSize));
    glb.addNode(floor);
    glb.addNode(wall);
    return glb;
}

}  // namespace

LODESTIR_LARGE_SCENE(makeStatue)

}  // namespace lodestir::generate
