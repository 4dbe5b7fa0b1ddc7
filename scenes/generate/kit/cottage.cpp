// SPDX-License-Identifier: MIT
// Small houses: see cottage.h.
#include "cottage.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "shapes.h"
#include "watercolour.h"

namespace lodestir::generate {

namespace {

Mesh boxAt(const glm::vec3& size, const glm::vec3& centre, float radius = 0.02f) { return placed(inTiles(roundedBox(size, radius, 1), washSize), centre); }

/// Walls with gables at both ends of x; the eaves run along x.
void addShell(Model& model, const CottagePaints& paints, const glm::vec3& size, float rise) {
    const float x = size.x / 2, h = size.y, z = size.z / 2;
    Mesh walls;
    const auto point = [&](const glm::vec3& p, const glm::vec2& uv) { return walls.add({.position = p, .uv = uv / washSize}); };
    for (float side : {1.0f, -1.0f}) {
        const auto front = [&](float px, float py) { return point({side * px, py, side * z}, {px, -py}); };
        walls.quad(front(-x, -0.6f), front(x, -0.6f), front(x, h), front(-x, h));
        const auto gable = [&](float pz, float py) { return point({side * x, py, side * -pz}, {pz + 1.3f, -py}); };
        walls.quad(gable(-z, -0.6f), gable(z, -0.6f), gable(z, h), gable(-z, h));
        walls.triangle(gable(-z, h), gable(z, h), gable(0, h + rise));
    }
    computeNormals(walls, 10);
    model.add(paints.wall, walls);

    // Slabs with overhanging eaves; old rafters sag a little in the middle.
    constexpr float over = 0.38f, thick = 0.12f;
    const float slope = std::atan2(rise, z), length = std::hypot(rise, z) + over / std::cos(slope);
    for (float side : {1.0f, -1.0f}) {
        Mesh slab = bent(inTiles(roundedBox({size.x + 2 * over, thick, length}, 0.03f, 2, Axis::x, 6), roofSize), [&](const glm::vec3& p) {
            const float along = 2 * p.x / (size.x + 2 * over);
            return p - glm::vec3(0, 0.07f * (1 - along * along) * (0.5f + p.z / length), 0);
        });
        const glm::mat4 tip =
            glm::rotate(glm::rotate(glm::translate(glm::mat4(1), {0, h + rise + thick * 0.6f, 0}), side > 0 ? 0.0f : 3.14159265f, {0, 1, 0}), slope, {1, 0, 0});
        model.add(paints.roof, placed(slab, tip * glm::translate(glm::mat4(1), {0, 0, length / 2 - 0.04f})));
    }
    model.add(paints.roof,
              placed(inTiles(tube(std::vector<Station>{{{-x - over, 0, 0}, 0.10f}, {{0, -0.03f, 0}, 0.10f}, {{x + over, 0, 0}, 0.10f}}, 8), roofSize),
                     {0, h + rise + 0.10f, 0}));
}

void addWindow(Model& model, const CottagePaints& paints, const glm::mat4& at, const glm::vec2& size, bool shutters) {
    const auto put = [&](int material, const Mesh& mesh) { model.add(material, placed(mesh, at)); };
    put(paints.trim, boxAt({size.x + 0.16f, size.y + 0.16f, 0.10f}, {0, 0, 0}));
    put(paints.pane, boxAt({size.x, size.y, 0.06f}, {0, 0, 0.030f}, 0.005f));
    put(paints.trim, boxAt({0.05f, size.y, 0.05f}, {0, 0, 0.05f}));
    put(paints.trim, boxAt({size.x, 0.045f, 0.05f}, {0, 0.08f * size.y, 0.05f}));
    put(paints.trim, boxAt({size.x + 0.30f, 0.07f, 0.20f}, {0, -size.y / 2 - 0.10f, 0.06f}));
    if (shutters)
        for (float side : {-1.0f, 1.0f}) put(paints.shutter, boxAt({size.x * 0.5f, size.y + 0.06f, 0.06f}, {side * (size.x * 0.78f + 0.07f), 0, 0.06f}));
}

glm::mat4 onWall(float turn, const glm::vec3& at) { return glm::translate(glm::rotate(glm::mat4(1), glm::radians(turn), {0, 1, 0}), at); }

}  // namespace

Model cottage(const std::string& name, const CottagePaints& paints, const glm::vec3& size, float pitch) {
    Model model{name, {}};
    const float rise = pitch * size.z / 2, z = size.z / 2, x = size.x / 2;
    addShell(model, paints, size, rise);
    const int across = std::max(int(size.x / 1.9f), 2);
    const bool storeys = size.y > 4;
    for (int i = 0; i < across; ++i) {
        const float at = (float(i) + 0.5f) / float(across) * size.x - x;
        const bool door = i == across / 2;
        for (float turn : {0.0f, 180.0f}) {
            if (!(door && turn == 0)) addWindow(model, paints, onWall(turn, {at, 1.45f, z}), {0.62f, 0.95f}, true);
            if (storeys) addWindow(model, paints, onWall(turn, {at, 4.0f, z}), {0.62f, 0.90f}, true);
        }
        if (door) {
            model.add(paints.trim, boxAt({1.12f, 2.2f, 0.12f}, {at, 1.06f, z}));
            model.add(paints.shutter, boxAt({0.90f, 2.06f, 0.10f}, {at, 1.0f, z + 0.04f}));
            model.add(paints.chimney, boxAt({1.5f, 0.18f, 0.7f}, {at, 0.04f, z + 0.35f}, 0.03f));
            model.add(paints.roof,
                      placed(boxAt({1.5f, 0.08f, 0.75f}, {0, 0, 0}), glm::rotate(glm::translate(glm::mat4(1), {at, 2.35f, z + 0.30f}), 0.45f, {1, 0, 0})));
        }
    }
    for (float turn : {90.0f, -90.0f}) {
        addWindow(model, paints, onWall(turn, {0, size.y + 0.28f * rise, x}), {0.55f, 0.75f}, false);
        addWindow(model, paints, onWall(turn, {0, 1.45f, x}), {0.62f, 0.95f}, true);
    }
    const glm::vec3 stack(0.28f * size.x, size.y + rise * 0.95f, -0.18f * size.z);
    model.add(paints.chimney, boxAt({0.62f, 1.9f, 0.62f}, stack, 0.03f));
    model.add(paints.chimney, boxAt({0.76f, 0.14f, 0.76f}, stack + glm::vec3(0, 0.9f, 0), 0.03f));
    for (float side : {-0.15f, 0.15f}) model.add(paints.roof, placed(inTiles(bar({side, 0.9f, 0}, {side, 1.28f, 0}, 0.10f, 10), washSize), stack));
    return model;
}

Model church(const std::string& name, const CottagePaints& paints) {
    Model model{name, {}};
    const glm::vec3 nave(9.5f, 4.2f, 5.6f);
    addShell(model, paints, nave, 3.4f);
    for (float turn : {0.0f, 180.0f})
        for (float x : {-3.0f, 0.0f, 3.0f}) addWindow(model, paints, onWall(turn, {x, 2.2f, nave.z / 2}), {0.7f, 1.9f}, false);
    const glm::vec3 tower(-nave.x / 2 - 1.2f, 0, 0);
    model.add(paints.wall, placed(inTiles(roundedBox({3.0f, 9.4f, 3.0f}, 0.04f), washSize), tower + glm::vec3(0, 4.1f, 0)));
    model.add(paints.trim, boxAt({3.3f, 0.24f, 3.3f}, tower + glm::vec3(0, 8.85f, 0), 0.05f));
    for (float turn : {0.0f, 90.0f, 180.0f, -90.0f})
        for (float y : {4.4f, 7.4f}) {
            const glm::mat4 stand = glm::translate(glm::mat4(1), tower) * onWall(turn, {0, y, 1.5f});
            addWindow(model, paints, stand, {0.7f, 1.4f}, false);
        }
    // The spire: square at its foot, eight-sided above.
    const glm::vec2 profile[] = {{0.02f, 15.6f}, {0.10f, 15.2f}, {1.35f, 10.4f}, {2.25f, 8.95f}};
    model.add(paints.roof, placed(inTiles(
                                      [&] {
                                          Mesh spire = turned(profile, 8, 20);
                                          scaleUv(spire, {8, 7});
                                          return spire;
                                      }(),
                                      roofSize),
                                  tower));
    const glm::vec2 knob[] = {{0, 16.4f}, {0.05f, 15.95f}, {0.16f, 15.8f}, {0.05f, 15.6f}, {0.05f, 15.2f}};
    model.add(paints.shutter, placed(turned(knob, 10), tower));
    return model;
}

}  // namespace lodestir::generate
