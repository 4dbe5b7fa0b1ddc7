// SPDX-License-Identifier: MIT
// A plate of 400 x 400 cells in eight materials: a cell is smaller than a texel of an impostor of 256, so that each texel has to know several.
#include <array>
#include <string>

#include "kit/backdrop.h"
#include "kit/scene.h"

namespace lodestir::generate {

namespace {

constexpr int cells = 400;
constexpr float half = 0.9f;  ///< of the plate, metres

Glb makeChecker() {
    Glb glb;
    // Reflectances far apart, in hue and in lightness; the last two are metals.
    const Material paints[] = {{.name = "white", .color = glm::vec3(0.85f), .roughness = 0.9f},
                               {.name = "black", .color = glm::vec3(0.02f), .roughness = 0.9f},
                               {.name = "red", .color = {0.75f, 0.05f, 0.03f}, .roughness = 0.9f},
                               {.name = "green", .color = {0.05f, 0.50f, 0.08f}, .roughness = 0.9f},
                               {.name = "blue", .color = {0.03f, 0.09f, 0.65f}, .roughness = 0.9f},
                               {.name = "yellow", .color = {0.80f, 0.60f, 0.03f}, .roughness = 0.9f},
                               {.name = "silver", .color = {0.90f, 0.89f, 0.86f}, .roughness = 0.5f, .metalness = 1},
                               {.name = "copper", .color = {0.90f, 0.50f, 0.35f}, .roughness = 0.5f, .metalness = 1}};
    constexpr int kinds = 8;
    std::array<Mesh, kinds> meshes;
    const auto corner = [](int x, int y) { return glm::vec3(half * (2 * float(x) / cells - 1), half * (1 - 2 * float(y) / cells), 0); };
    for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x) {
            Mesh& mesh = meshes[size_t((x + 3 * y) % kinds)];  // eight in a row and in a column are all different
            uint32_t ring[4];
            const glm::ivec2 corners[] = {{x, y}, {x, y + 1}, {x + 1, y + 1}, {x + 1, y}};
            for (int k = 0; k < 4; ++k)
                ring[k] = mesh.add({.position = corner(corners[k].x, corners[k].y), .normal = {0, 0, 1}, .uv = glm::vec2(corners[k]) / float(cells)});
            mesh.quad(ring[0], ring[1], ring[2], ring[3]);
        }
    Model model{"checker", {}};
    for (int i = 0; i < kinds; ++i) model.add(glb.addMaterial(paints[i]), meshes[size_t(i)]);
    glb.addNode(model);
    addLamp(glb, {0, 0, 0}, 1, {11, 10.2f, 9});
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeChecker)

}  // namespace lodestir::generate
