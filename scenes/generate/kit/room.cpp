// SPDX-License-Identifier: MIT
// The shell of the interior: see room.h.
#include "room.h"

#include <array>
#include <cmath>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "cloth.h"
#include "grass.h"
#include "joinery.h"
#include "masonry.h"
#include "noise.h"
#include "random.h"
#include "shapes.h"
#include "wood.h"

namespace lodestir::generate {

namespace {

constexpr float doorSill = 0.06f;  ///< metres above the floor

/// A flat part with UVs in metres over `repeat`.
Mesh sheet(const glm::vec3& corner, const glm::vec3& right, const glm::vec3& down, float repeat) {
    Mesh mesh = rectangle(corner, right, down);
    scaleUv(mesh, glm::vec2(glm::length(right), glm::length(down)) / repeat);
    return mesh;
}

/// A rectangle with an opening from `low` to `high` (shares of right and down) and its four reveals, `outward` deep. The wall is a three by
/// three lattice without its middle: all pieces share corners, so no ray slips through a joint.
Mesh piercedWall(const glm::vec3& corner, const glm::vec3& right, const glm::vec3& down, const glm::vec2& low, const glm::vec2& high,
                 const glm::vec3& outward) {
    const auto at = [&](float s, float t) { return corner + right * s + down * t; };
    const std::array<float, 4> s{0, low.x, high.x, 1}, t{0, low.y, high.y, 1};
    const glm::vec2 metres(glm::length(right), glm::length(down));
    Mesh mesh;
    for (size_t j = 0; j < 3; ++j)
        for (size_t i = 0; i < 3; ++i) {
            if (i == 1 && j == 1) continue;
            Mesh piece;
            for (const auto& [a, b] : {std::pair{i, j}, std::pair{i, j + 1}, std::pair{i + 1, j + 1}, std::pair{i + 1, j}})
                piece.add({.position = at(s[a], t[b]), .uv = glm::vec2(s[a], t[b]) * metres / plasterSize});
            piece.quad(0, 1, 2, 3);
            append(mesh, piece);
        }
    computeNormals(mesh, 10);
    const glm::vec3 across = right * (high.x - low.x), fall = down * (high.y - low.y);
    append(mesh, sheet(at(low.x, low.y), outward, fall, plasterSize));
    append(mesh, sheet(at(high.x, low.y) + outward, -outward, fall, plasterSize));
    append(mesh, sheet(at(low.x, low.y) + outward, -outward, across, plasterSize));
    append(mesh, sheet(at(low.x, high.y), outward, across, plasterSize));
    return mesh;
}

/// Boards along the foot of a wall, or a moulding along its top.
void addRun(Model& model, int material, const glm::vec3& from, const glm::vec3& to, float height, float depth, float radius) {
    const glm::vec3 d = glm::abs(to - from);
    const bool alongX = d.x > d.z;
    const glm::vec3 size = alongX ? glm::vec3(d.x, height, depth) : glm::vec3(depth, height, d.z);
    model.add(material, placed(roundedBox(size, radius, 3), (from + to) * 0.5f));
}

Model window(const Palette& palette, const Room& room) {
    Model window{"window", {}};
    const float x = -room.halfWidth - room.wallThickness * 0.62f;
    const float height = room.lintel - room.sill, width = room.windowFront - room.windowBack;
    const float y0 = room.sill, zMiddle = (room.windowFront + room.windowBack) / 2;
    const auto bar = [&](const glm::vec3& size, const glm::vec3& centre) {
        window.add(palette.trim, placed(roundedBox(size, 0.006f, 2), centre));
    };

    constexpr float frame = 0.055f;
    for (float side : {-1.0f, 1.0f}) {
        bar({0.085f, height, frame}, {x, y0 + height / 2, zMiddle + side * (width - frame) / 2});
        bar({0.085f, frame, width}, {x, y0 + height / 2 + side * (height - frame) / 2, zMiddle});
    }
    // Three casements, each with its own sash and two glazing bars.
    constexpr int casements = 3;
    const float cell = (width - 2 * frame) / casements;
    for (int i = 0; i < casements; ++i) {
        const float z = room.windowBack + frame + (float(i) + 0.5f) * cell;
        if (i > 0) bar({0.085f, height - 2 * frame, 0.04f}, {x, y0 + height / 2, z - cell / 2});
        for (float side : {-1.0f, 1.0f}) {
            bar({0.05f, height - 2 * frame - 0.006f, 0.042f}, {x + 0.012f, y0 + height / 2, z + side * (cell / 2 - 0.040f)});
            bar({0.05f, 0.046f, cell - 0.04f}, {x + 0.012f, y0 + height / 2 + side * (height / 2 - frame - 0.024f), z});
        }
        bar({0.026f, 0.024f, cell - 0.08f}, {x + 0.012f, y0 + height * 0.68f, z});
        if (i == 1) {
            const Station handle[] = {{{x + 0.045f, y0 + height * 0.46f, z - cell / 2 + 0.04f}, 0.007f},
                                      {{x + 0.075f, y0 + height * 0.46f, z - cell / 2 + 0.04f}, 0.007f},
                                      {{x + 0.078f, y0 + height * 0.455f, z - cell / 2 + 0.04f}, 0.007f},
                                      {{x + 0.076f, y0 + height * 0.46f - 0.1f, z - cell / 2 + 0.04f}, 0.006f}};
            window.add(palette.brass, tube(handle, 12));
        }
    }

    // Inside: a deep sill board and a casing that covers the edge of the plaster.
    const float inner = -room.halfWidth, sillDepth = room.wallThickness * 0.55f + 0.06f;
    window.add(palette.trim,
               placed(roundedBox({sillDepth, 0.034f, width + 0.16f}, 0.010f, 3), {inner + 0.06f - sillDepth / 2, y0 + 0.005f, zMiddle}));
    for (float side : {-1.0f, 1.0f})
        window.add(palette.trim, placed(roundedBox({0.022f, height + 0.07f, 0.075f}, 0.006f, 2),
                                        {inner + 0.011f, y0 + (height + 0.07f) / 2, zMiddle + side * (width / 2 + 0.034f)}));
    window.add(palette.trim,
               placed(roundedBox({0.024f, 0.085f, width + 0.19f}, 0.006f, 2), {inner + 0.012f, room.lintel + 0.040f, zMiddle}));
    return window;
}

/// Two glazed leaves in the front wall, behind the usual camera: they fill the room with sky.
Model gardenDoor(const Palette& palette, const Room& room) {
    Model door{"garden_door", {}};
    const float z = room.front + room.wallThickness * 0.5f, width = room.doorRight - room.doorLeft, height = room.doorHead - doorSill;
    const float xMiddle = (room.doorLeft + room.doorRight) / 2, yMiddle = (room.doorHead + doorSill) / 2;
    const auto bar = [&](const glm::vec2& size, const glm::vec2& centre) {
        door.add(palette.trim, placed(roundedBox({size.x, size.y, 0.06f}, 0.006f, 2), {centre.x, centre.y, z}));
    };
    for (float side : {-1.0f, 1.0f}) {
        bar({0.06f, height}, {xMiddle + side * (width - 0.06f) / 2, yMiddle});
        bar({width, 0.06f}, {xMiddle, yMiddle + side * (height - 0.06f) / 2});
        const float leaf = xMiddle + side * width / 4;
        for (float edge : {-1.0f, 1.0f}) bar({0.08f, height - 0.1f}, {leaf + edge * (width / 4 - 0.06f), yMiddle});
        for (float rail : {0.06f, 0.36f, 0.66f, 0.95f})
            bar({width / 2 - 0.1f, rail < 0.1f ? 0.16f : 0.045f}, {leaf, doorSill + rail * height});
    }
    return door;
}

Model curtains(const Palette& palette, const Room& room) {
    Model model{"curtains", {}};
    const float y = 2.52f, x = -room.halfWidth + 0.115f, length = y - 0.025f;
    const float ends[] = {room.windowBack - 0.20f, room.windowFront + 0.22f};
    uint32_t seed = 31;
    for (float z : ends) {
        Mesh cloth = curtain(seed++, 0.56f, length);
        scaleUv(cloth, glm::vec2(1 / weaveSize));
        const glm::mat4 turn = glm::rotate(glm::translate(glm::mat4(1), glm::vec3(x, y, z)), glm::radians(90.0f), glm::vec3(0, 1, 0));
        model.add(palette.linen, placed(cloth, turn));
    }
    const Station pole[] = {
        {{x, y + 0.02f, ends[0] - 0.36f}, 0.012f}, {{x, y + 0.02f, 0}, 0.012f}, {{x, y + 0.02f, ends[1] + 0.36f}, 0.012f}};
    model.add(palette.brass, tube(pole, 16));
    for (float z : {ends[0] - 0.37f, ends[1] + 0.37f})
        model.add(palette.brass,
                  placed(sphere(24, 14), glm::scale(glm::translate(glm::mat4(1), glm::vec3(x, y + 0.02f, z)), glm::vec3(0.024f))));
    return model;
}

}  // namespace

void addRoom(Glb& glb, const Palette& palette, const Room& room) {
    const float w = room.halfWidth, h = room.height, b = room.back, f = room.front;

    Model floor{"floor", {}};
    // Herringbone lies at 45 degrees to the walls.
    Mesh boards = rectangle({-w, 0, b}, {2 * w, 0, 0}, {0, 0, f - b});
    for (Vertex& v : boards.vertices) {
        const glm::vec2 p(v.position.x, v.position.z);
        v.uv = glm::vec2(p.x + p.y, p.y - p.x) * 0.70710678f / herringboneSize;
    }
    floor.add(palette.floor, boards);
    glb.addNode(floor);

    Model walls{"walls", {}};
    const float depth = f - b, thick = room.wallThickness;
    walls.add(palette.wall, piercedWall({-w, h, f}, {0, 0, -depth}, {0, -h, 0}, {(f - room.windowFront) / depth, (h - room.lintel) / h},
                                        {(f - room.windowBack) / depth, (h - room.sill) / h}, {-thick, 0, 0}));
    walls.add(palette.wall, piercedWall({w, h, f}, {-2 * w, 0, 0}, {0, -h, 0}, {(w - room.doorRight) / (2 * w), (h - room.doorHead) / h},
                                        {(w - room.doorLeft) / (2 * w), (h - doorSill) / h}, {0, 0, thick}));
    walls.add(palette.accent, sheet({-w, h, b}, {2 * w, 0, 0}, {0, -h, 0}, plasterSize));
    walls.add(palette.wall, sheet({w, h, b}, {0, 0, f - b}, {0, -h, 0}, plasterSize));
    walls.add(palette.ceiling, sheet({-w, h, f}, {2 * w, 0, 0}, {0, 0, b - f}, plasterSize));
    glb.addNode(walls);

    Model mouldings{"mouldings", {}};
    struct Run {
        glm::vec2 from, to;
    };
    // Half of each board is in the wall. The skirting leaves the door free.
    for (const Run& run : {Run{{-w, b}, {w, b}}, Run{{-w, f}, {room.doorLeft - 0.02f, f}}, Run{{room.doorRight + 0.02f, f}, {w, f}},
                           Run{{-w, b}, {-w, f}}, Run{{w, b}, {w, f}}})
        addRun(mouldings, palette.trim, {run.from.x, 0.055f, run.from.y}, {run.to.x, 0.055f, run.to.y}, 0.11f, 0.036f, 0.007f);
    for (const Run& run : {Run{{-w, b}, {w, b}}, Run{{-w, f}, {w, f}}, Run{{-w, b}, {-w, f}}, Run{{w, b}, {w, f}}})
        addRun(mouldings, palette.trim, {run.from.x, h - 0.02f, run.from.y}, {run.to.x, h - 0.02f, run.to.y}, 0.07f, 0.10f, 0.02f);
    glb.addNode(mouldings);
    glb.addNode(window(palette, room));
    glb.addNode(gardenDoor(palette, room));
    glb.addNode(curtains(palette, room));
}

void addGarden(Glb& glb, const Palette& palette, const Room& room) {
    const Noise noise{66};
    Model lawn{"lawn", {}};
    const float edge = -room.halfWidth - room.wallThickness;
    Mesh ground = grid(40, 40, [&](float u, float v) {
        const float x = edge - 22 * (1 - u), z = -20 + 32 * v;
        return glm::vec3(x, -0.35f + 0.06f * noise.fractal({x * 0.4f, z * 0.4f, 0.5f}, 3), z);
    });
    for (Vertex& v : ground.vertices) v.color = glm::vec3(0.085f, 0.13f, 0.032f) * (1 + 0.5f * noise.fractal(v.position * 0.7f, 4));
    ground.hasColors = true;
    lawn.add(palette.grass, ground);
    glb.addNode(lawn);

    Model bush{"hedge", {}};
    bush.add(palette.grass, shrub(640, 3200));
    const int hedge = glb.addMesh(bush);
    Random random(65);
    // Taller bushes behind the hedge break the skyline.
    for (int i = 0; i < 9; ++i) {
        const float z = -16 + 2.1f * float(i) + random.between(-0.8f, 0.8f);
        glb.addNode("bush_" + std::to_string(i), hedge,
                    {.translation = {edge - random.between(9, 15), -0.8f, z},
                     .rotation = turnY(random.between(0, 360)),
                     .scale = glm::vec3(random.between(4, 6))});
    }
    for (int i = 0; i < 22; ++i) {
        const float z = -17 + 1.05f * float(i) + random.between(-0.2f, 0.2f);
        glb.addNode("hedge_" + std::to_string(i), hedge,
                    {.translation = {edge - 5.6f + random.between(-0.4f, 0.4f), -0.55f, z},
                     .rotation = turnY(random.between(0, 360)),
                     .scale = glm::vec3(random.between(1.9f, 2.6f))});
    }
}

}  // namespace lodestir::generate
