// SPDX-License-Identifier: MIT
// Boulders: see boulders.h.
#include "boulders.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "random.h"
#include "stone.h"
#include "terrain.h"

namespace lodestir::generate {

namespace {

constexpr int rows = 64;                     ///< of the grid that the boulders are shaken out of; as many a row
constexpr float nearest = 3, farthest = 170;  ///< metres from where a viewer stands, at (0, 4)
constexpr int chartTexels = 256;

/// Where a cell of the grid lies: rows grow apart as they grow smaller to the eye, so that each distance has its share of the picture.
glm::vec2 place(float u, float v) {
    const float away = nearest * std::pow(farthest / nearest, v);
    return {(u - 0.5f) * (7 + 1.5f * away), 4 - away};
}

void addBoulders(Glb& glb, const Terrain& terrain, int boulder) {
    Random random(6);
    for (int i = 0; i < boulderCount; ++i) {
        const float u = (float(i % rows) + random.next()) / rows, v = (float(i / rows) + random.next()) / rows;
        const glm::vec2 xz = place(u, v);
        // Few large ones, many small; farther off only larger ones are left, or nothing would be seen of them.
        const float size = 0.06f * std::pow(12.0f, std::pow(random.next(), 2.6f)) * (1 + 0.018f * (4 - xz.y));
        const glm::vec3 shape = glm::vec3(random.between(0.8f, 1.2f), random.between(0.7f, 1.1f), random.between(0.8f, 1.2f)) * size;
        // Fallen as they fell: turned about the vertical, then rolled over by up to a third.
        const glm::quat roll = glm::angleAxis(random.between(-1.0f, 1.0f), glm::normalize(glm::vec3(random.bell(), 0.01f, random.bell())));
        glb.addNode("boulder_" + std::to_string(i), boulder,
                    {.translation = {xz.x, terrain.height(xz) + size * random.between(0.3f, 0.65f), xz.y},
                     .rotation = roll * turnY(random.between(0, 360)),
                     .scale = shape});
    }
}

}  // namespace

Glb boulderField(int growth) {
    Glb glb;
    const Stone stone(44, {.size = {1.2f, 0.95f, 1.05f}, .facets = 15, .sharpness = 18, .relief = 1});
    const Mesh mesh = stone.mesh(boulderCells * growth);
    const int material = glb.addMaterial(glb.dressed({.name = "boulder"}, stone.bake(mesh, chartTexels)));
    const Terrain terrain(12);
    addBoulders(glb, terrain, glb.addMesh("boulder", {{glb.addGeometry(mesh), material}}));
    Model ground{"terrain", {}};
    ground.add(glb.addMaterial(glb.dressed({.name = "ground"}, paintGround(3, 768))), terrain.mesh(256));
    glb.addNode(ground);
    return glb;
}

}  // namespace lodestir::generate
