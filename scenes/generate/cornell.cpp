// SPDX-License-Identifier: MIT
// The Cornell box, from the measured data of the Cornell University Program of Computer Graphics ("Cornell Box Data", geometry in
// millimetres), and a glossy variant with spheres of glass and rough gold.
#include <array>

#include "glb.h"
#include "scenes.h"
#include "shapes.h"

namespace lodestir::generate {

namespace {

using Corner = glm::vec3;
using Quad = std::array<Corner, 4>;

/// Millimetres of the published data to scene units: the box is about 5.5 units wide.
constexpr float scale = 0.01f;

/// One quad as listed (counter-clockwise from inside the box), its UVs filling a cell of an atlas: no two faces of an object share texels.
Mesh face(const Quad& quad, const glm::vec2& cell = glm::vec2(0), const glm::vec2& cells = glm::vec2(1)) {
    const glm::vec2 corners[4] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    constexpr float margin = 0.02f;
    Mesh mesh;
    const glm::vec3 normal = glm::normalize(glm::cross(quad[1] - quad[0], quad[2] - quad[0]));
    for (size_t i = 0; i < 4; ++i)
        mesh.add({.position = quad[i] * scale, .normal = normal, .uv = (cell + margin + corners[i] * (1 - 2 * margin)) / cells});
    mesh.quad(0, 1, 2, 3);
    return mesh;
}

/// A block: its top as listed, walls straight down to the floor.
Mesh block(const Quad& top) {
    Mesh mesh = face(top, {0, 0}, {3, 2});
    for (size_t i = 0; i < 4; ++i) {
        const Corner a = top[i], b = top[(i + 1) % 4];
        const glm::vec2 cell((i + 1) % 3, (i + 1) / 3);
        append(mesh, face({a, {a.x, 0, a.z}, {b.x, 0, b.z}, b}, cell, {3, 2}));
    }
    return mesh;
}

const Quad shortTop = {{{130, 165, 65}, {82, 165, 225}, {240, 165, 272}, {290, 165, 114}}};
const Quad tallTop = {{{423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}}};

struct Paints {
    int white, red, green, light;
};

/// The measured spectra as linear Rec.709 reflectances; the lamp's spectrum as radiance, rounded.
Paints addPaints(Glb& glb) {
    return {glb.addMaterial({.name = "white", .color = {0.725f, 0.71f, 0.68f}}),
            glb.addMaterial({.name = "red", .color = {0.63f, 0.065f, 0.05f}}),
            glb.addMaterial({.name = "green", .color = {0.14f, 0.45f, 0.091f}}),
            glb.addMaterial({.name = "light", .color = {0.78f, 0.78f, 0.78f}, .emission = {18.4f, 14.0f, 6.8f}})};
}

void addBox(Glb& glb, const Paints& paints) {
    constexpr float y = 548.8f, back = 559.2f;
    Model room{"room", {}};
    int cell = 0;
    const auto wall = [&](int material, const Quad& quad) {
        room.add(material, face(quad, {cell % 3, cell / 3}, {3, 3}));
        ++cell;
    };
    wall(paints.white, {{{552.8f, 0, 0}, {0, 0, 0}, {0, 0, back}, {549.6f, 0, back}}});     // floor
    wall(paints.white, {{{549.6f, 0, back}, {0, 0, back}, {0, y, back}, {556, y, back}}});  // back
    wall(paints.green, {{{0, 0, back}, {0, 0, 0}, {0, y, 0}, {0, y, back}}});               // right
    wall(paints.red, {{{552.8f, 0, 0}, {549.6f, 0, back}, {556, y, back}, {556, y, 0}}});   // left

    // The ceiling has a hole where the lamp sits; four strips leave it open.
    constexpr float x0 = 213, x1 = 343, z0 = 227, z1 = 332;
    wall(paints.white, {{{556, y, 0}, {556, y, z0}, {0, y, z0}, {0, y, 0}}});
    wall(paints.white, {{{556, y, z1}, {556, y, back}, {0, y, back}, {0, y, z1}}});
    wall(paints.white, {{{556, y, z0}, {556, y, z1}, {x1, y, z1}, {x1, y, z0}}});
    wall(paints.white, {{{x0, y, z0}, {x0, y, z1}, {0, y, z1}, {0, y, z0}}});
    glb.addNode(room);

    Model lamp{"light", {}};
    lamp.add(paints.light, face({{{x1, y, z0}, {x1, y, z1}, {x0, y, z1}, {x0, y, z0}}}));
    glb.addNode(lamp);
}

void addObject(Glb& glb, const std::string& name, int material, const Mesh& mesh, const Placement& placement = {}) {
    Model model{name, {}};
    model.add(material, mesh);
    glb.addNode(model, placement);
}

void writeCornell(const std::filesystem::path& folder) {
    Glb classic;
    const Paints paints = addPaints(classic);
    addBox(classic, paints);
    addObject(classic, "short_block", paints.white, block(shortTop));
    addObject(classic, "tall_block", paints.white, block(tallTop));
    classic.write(folder / "cornell.glb");

    Glb glossy;
    const Paints walls = addPaints(glossy);
    addBox(glossy, walls);
    // Reflectance of gold at normal incidence, linear Rec.709.
    const int gold = glossy.addMaterial({.name = "gold_rough", .color = {1.0f, 0.78f, 0.34f}, .roughness = 0.3f, .metalness = 1});
    const int glass = glossy.addMaterial({.name = "glass",
                                          .roughness = 0,
                                          .transmission = 1,
                                          .ior = 1.5f,
                                          .thickness = 1.9f,
                                          .attenuation = {0.86f, 0.97f, 0.94f},
                                          .attenuationDistance = 3});
    addObject(glossy, "tall_block", walls.white, block(tallTop));
    addObject(glossy, "glass_sphere", glass, sphere(128, 64), {.translation = {1.72f, 0.951f, 1.62f}, .scale = glm::vec3(0.95f)});
    addObject(glossy, "gold_sphere", gold, sphere(128, 64), {.translation = {4.02f, 0.751f, 1.35f}, .scale = glm::vec3(0.75f)});
    glossy.write(folder / "cornell_glossy.glb");
}

}  // namespace

LODESTIR_SCENE(cornell, writeCornell)

}  // namespace lodestir::generate
