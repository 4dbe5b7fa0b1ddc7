// SPDX-License-Identifier: MIT
#include "cornell_box.h"

#include <array>

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

}  // namespace

// The measured spectra as linear Rec.709 reflectances; the lamp's spectrum as radiance, rounded.
CornellBox::CornellBox() : white(glb.addMaterial({.name = "white", .color = {0.725f, 0.71f, 0.68f}})) {
    const int red = glb.addMaterial({.name = "red", .color = {0.63f, 0.065f, 0.05f}}),
              green = glb.addMaterial({.name = "green", .color = {0.14f, 0.45f, 0.091f}}),
              light = glb.addMaterial({.name = "light", .color = {0.78f, 0.78f, 0.78f}, .emission = {18.4f, 14.0f, 6.8f}});
    constexpr float y = 548.8f, back = 559.2f;
    Model room{"room", {}};
    int cell = 0;
    const auto wall = [&](int material, const Quad& quad) {
        room.add(material, face(quad, {cell % 3, cell / 3}, {3, 3}));
        ++cell;
    };
    wall(white, {{{552.8f, 0, 0}, {0, 0, 0}, {0, 0, back}, {549.6f, 0, back}}});     // floor
    wall(white, {{{549.6f, 0, back}, {0, 0, back}, {0, y, back}, {556, y, back}}});  // back
    wall(green, {{{0, 0, back}, {0, 0, 0}, {0, y, 0}, {0, y, back}}});               // right
    wall(red, {{{552.8f, 0, 0}, {549.6f, 0, back}, {556, y, back}, {556, y, 0}}});   // left

    // The ceiling has a hole where the lamp sits; four strips leave it open.
    constexpr float x0 = 213, x1 = 343, z0 = 227, z1 = 332;
    wall(white, {{{556, y, 0}, {556, y, z0}, {0, y, z0}, {0, y, 0}}});
    wall(white, {{{556, y, z1}, {556, y, back}, {0, y, back}, {0, y, z1}}});
    wall(white, {{{556, y, z0}, {556, y, z1}, {x1, y, z1}, {x1, y, z0}}});
    wall(white, {{{x0, y, z0}, {x0, y, z1}, {0, y, z1}, {0, y, z0}}});
    glb.addNode(room);

    Model lamp{"light", {}};
    lamp.add(light, face({{{x1, y, z0}, {x1, y, z1}, {x0, y, z1}, {x0, y, z0}}}));
    glb.addNode(lamp);
}

void CornellBox::put(const std::string& name, int material, const Mesh& mesh, const Placement& placement) {
    Model model{name, {}};
    model.add(material, mesh);
    glb.addNode(model, placement);
}

Mesh shortBlock() { return block(shortTop); }
Mesh tallBlock() { return block(tallTop); }

}  // namespace lodestir::generate
