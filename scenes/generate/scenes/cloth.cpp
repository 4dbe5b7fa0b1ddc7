// SPDX-License-Identifier: MIT
// A damask cloth that fell over a round table and a ball on it; its pattern is woven into the mesh. A still life stands on it.
#include <algorithm>
#include <string>
#include <vector>

#include "kit/drape.h"
#include "kit/masonry.h"
#include "kit/metals.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/slab.h"
#include "kit/still_life.h"
#include "kit/tableware.h"
#include "kit/teapot.h"
#include "kit/wood.h"

namespace lodestir::generate {

namespace {

constexpr float tableRadius = 0.56f, tableHeight = 0.74f, topThickness = 0.03f;
constexpr glm::vec4 hidden(-0.20f, tableHeight + 0.17f, -0.14f, 0.17f);  ///< a ball under the cloth: centre, radius
constexpr glm::vec2 clothSize(1.86f);
constexpr int clothCells = 304;  ///< 184,832 triangles: three vertices for ten texels of its displacement
constexpr int displacementTexels = 1024;
constexpr float displacement = 0.006f;  ///< metres

/// The table is solid down to the floor, a little drawn in, or the skirts would pull the cloth through its top.
float obstacle(const glm::vec3& p) {
    constexpr float edge = 0.025f, drawnIn = 0.34f;
    const float out = glm::length(glm::vec2(p.x, p.z)) - tableRadius + drawnIn * std::max(1 - p.y / tableHeight, 0.0f);
    const glm::vec2 q = glm::vec2(out, p.y - tableHeight) + edge;
    const float table = glm::length(glm::max(q, 0.0f)) + std::min(std::max(q.x, q.y), 0.0f) - edge;
    return std::min({p.y, table, glm::distance(p, glm::vec3(hidden)) - hidden.w});
}

/// The damask as a picture of heights, 1,024 a side, read between its texels.
class Displacement {
public:
    Displacement() {
        for (int y = 0; y < displacementTexels; ++y)
            for (int x = 0; x < displacementTexels; ++x) heights.push_back(damask((glm::vec2(x, y) + 0.5f) / float(displacementTexels) * clothSize));
    }
    float at(const glm::vec2& uv) const {
        const glm::vec2 p = glm::clamp(uv * float(displacementTexels) - 0.5f, 0.0f, displacementTexels - 1.001f);
        const glm::ivec2 c(p);
        const glm::vec2 f = p - glm::vec2(c);
        const float* h = &heights[size_t(c.y * displacementTexels + c.x)];
        return displacement * glm::mix(glm::mix(h[0], h[1], f.x), glm::mix(h[displacementTexels], h[displacementTexels + 1], f.x), f.y);
    }

private:
    std::vector<float> heights;
};

void addRoom(Glb& glb) {
    Model room{"room", {}};
    const int parquet = glb.addMaterial(glb.dressed({.name = "parquet"}, paintHerringbone(walnut(), 3, 768))),
              plaster = glb.addMaterial(glb.dressed({.name = "plaster"}, paintPlaster({0.30f, 0.33f, 0.30f}, 4, 512))),
              white = glb.addMaterial({.name = "panelling", .color = {0.62f, 0.60f, 0.55f}, .roughness = 0.45f});
    room.add(parquet, slab({-3.2f, -0.1f, -1.3f}, {3.2f, 0, 3.4f}, herringboneSize));
    room.add(plaster, slab({-3.2f, 0, -1.5f}, {3.2f, 3, -1.3f}, plasterSize));
    // Panelling: skirting, rail, framed fields.
    room.add(white, slab({-3.2f, 0, -1.3f}, {3.2f, 0.88f, -1.285f}, 1));
    room.add(white, slab({-3.2f, 0, -1.3f}, {3.2f, 0.14f, -1.265f}, 1, 0.008f));
    room.add(white, slab({-3.2f, 0.88f, -1.3f}, {3.2f, 0.94f, -1.25f}, 1, 0.012f));
    for (int i = -4; i < 4; ++i) {
        const float x = 0.8f * float(i);
        for (float y : {0.22f, 0.76f}) room.add(white, slab({x + 0.08f, y, -1.29f}, {x + 0.72f, y + 0.035f, -1.265f}, 1, 0.01f));
        for (float edge : {0.08f, 0.685f}) room.add(white, slab({x + edge, 0.22f, -1.29f}, {x + edge + 0.035f, 0.795f, -1.265f}, 1, 0.01f));
    }
    glb.addNode(room);
    Model window{"window", {}};
    window.add(glb.addMaterial(glow("window", {15, 14.2f, 12.8f})), panel({-2.9f, 1.75f, 0.9f}, {1, -0.25f, -0.25f}, {1.5f, 1.9f}));
    glb.addNode(window);
}

Model table(Glb& glb) {
    Model model{"table", {}};
    const int wood = glb.addMaterial(
        glb.dressed({.name = "mahogany"}, paintPanel({.early = {0.20f, 0.075f, 0.03f}, .late = {0.10f, 0.035f, 0.015f}, .roughness = 0.3f}, 5, 256)));
    const float r = tableRadius - 0.02f, t = tableHeight - 0.004f;  // or its rim would cut through the cloth, whose particles pass over it
    const glm::vec2 top[] = {{0, t}, {r - 0.012f, t}, {r, t - 0.012f}, {r - 0.004f, t - topThickness}, {0, t - topThickness}};
    const glm::vec2 foot[] = {{0.10f, t - topThickness},
                              {0.055f, 0.62f},
                              {0.045f, 0.50f},
                              {0.085f, 0.36f},
                              {0.05f, 0.24f},
                              {0.09f, 0.16f},
                              {0.22f, 0.05f},
                              {0.26f, 0.03f},
                              {0.26f, 0}};
    model.add(wood, turned(top, 64)), model.add(wood, turned(smoothCurve(foot, 4), 40));
    return model;
}

void addThings(Glb& glb) {
    const int porcelain = glb.addMaterial({.name = "porcelain", .color = {0.72f, 0.72f, 0.70f}, .roughness = 0.12f}),
              glaze = glb.addMaterial(glb.dressed({.name = "glaze"}, paintEarthenware({0.06f, 0.16f, 0.30f}, 3, 256))),
              pewter = glb.addMaterial({.name = "silver", .color = silver, .roughness = 0.22f, .metalness = 1}),
              skin = glb.addMaterial({.name = "fruit", .roughness = 0.38f});
    // The cloth lies a little above the table, its figures higher.
    const float y = tableHeight + 0.013f;
    glb.addNode(teapot("teapot", pewter, 0.19f), {.translation = {0.33f, y, -0.04f}, .rotation = turnY(215)});
    glb.addNode(bowl("bowl", glaze, 0.14f), {.translation = {0.06f, y, 0.30f}});
    glb.addNode(fruit("fruit", skin, 11, 0.14f), {.translation = {0.06f, y, 0.30f}});
    glb.addNode(mug("cup", porcelain), {.translation = {0.36f, y, 0.20f}, .rotation = turnY(-40)});
    const glm::vec3 dropped[] = {{-0.72f, 0.038f, 0.50f}, {-0.60f, 0.038f, 0.62f}};
    const int lemon = glb.addMesh("lemon", placed(sphere(32, 20), glm::mat4(glm::mat3(0.038f))),
                                  glb.addMaterial({.name = "lemon", .color = {0.72f, 0.48f, 0.04f}, .roughness = 0.45f}));
    int number = 0;
    for (const glm::vec3& place : dropped) glb.addNode("lemon_" + std::to_string(number++), lemon, {.translation = place, .scale = {1.25f, 1, 1}});
}

Glb makeCloth() {
    Glb glb;
    const Displacement heights;
    const Drape drape{.size = clothSize, .centre = {0, tableHeight + 0.42f, 0}, .turn = 0.5f, .obstacle = obstacle};
    Model cloth{"cloth", {}};
    cloth.add(
        glb.addMaterial(glb.dressed({.name = "damask", .doubleSided = true}, paintDamask(clothSize, {0.23f, 0.012f, 0.022f}, {0.62f, 0.36f, 0.12f}, 6, 1280))),
        draped(drape, clothCells, [&](const glm::vec2& uv) { return heights.at(uv); }));
    glb.addNode(cloth);
    addRoom(glb);
    glb.addNode(table(glb));
    addThings(glb);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeCloth, "--levels 4 --ratio 4 --mesh cloth")

}  // namespace lodestir::generate
