// SPDX-License-Identifier: MIT
// A spaceship of glass: see glass_ship.h.
#include "glass_ship.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "shapes.h"
#include "spline.h"

namespace lodestir::generate {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float halfLength = 3.8f;

/// The same surface seen from its other side: a bubble.
Mesh reversed(Mesh mesh) {
    for (Vertex& v : mesh.vertices) v.normal = -v.normal;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    return mesh;
}

Mesh ellipsoid(const glm::vec3& centre, const glm::vec3& radii, int columns = 48) {
    return placed(sphere(columns, columns / 2), glm::scale(glm::translate(glm::mat4(1), centre), radii));
}

/// A point of the hull's surface, drawn in by a share: `along` from -1 (tail) to 1, `turn` around it from +z upward.
glm::vec3 hullAt(float along, float turn, float share) {
    const glm::vec2 girth = shipGirth(halfLength * along) * share;
    return {halfLength * along, girth.x * std::sin(turn), girth.y * std::cos(turn)};
}

Mesh hull() {
    // The poles of a sphere become nose and tail.
    return bent(
        sphere(96, 72),
        [](const glm::vec3& d) {
            const glm::vec2 girth = shipGirth(halfLength * d.y);
            const float flat = std::max(std::hypot(d.x, d.z), 1e-6f);
            return glm::vec3(halfLength * d.y, girth.x * d.x / flat, girth.y * d.z / flat);
        },
        180);
}

void addSkeleton(Model& model, const ShipMaterials& material) {
    for (float along : {-0.74f, -0.42f, 0.20f, 0.80f}) {
        std::vector<Station> ring;
        for (int i = 0; i <= 40; ++i) ring.push_back({hullAt(along, 2 * pi * float(i) / 40, 0.93f), 0.030f});
        model.add(material.gold, tube(ring, 8, 180));
    }
    for (int k = 0; k < 6; ++k) {
        std::vector<Station> rib;
        for (int i = 0; i <= 32; ++i) rib.push_back({hullAt(-0.88f + 1.78f * float(i) / 32, pi * (float(k) + 0.5f) / 3, 0.93f), 0.022f});
        model.add(material.gold, tube(rib, 6, 180));
    }
}

/// A bubble, a ball of coloured glass in it, and a star in a bubble of that: light leaves through three surfaces.
void addReactor(Model& model, const ShipMaterials& material, const glm::vec3& at, float radius, int ball) {
    model.add(material.hull, reversed(ellipsoid(at, glm::vec3(radius), 56)));
    model.add(ball, ellipsoid(at, glm::vec3(0.70f * radius)));
    model.add(material.star, ellipsoid(at, glm::vec3(0.27f * radius), 16));
    // A gyroscope of two rings floats around the ball.
    for (float tip : {0.5f, -0.9f}) {
        std::vector<Station> ring;
        for (int i = 0; i <= 40; ++i) {
            const float a = 2 * pi * float(i) / 40;
            const glm::vec3 p(std::cos(a), std::sin(a) * std::cos(tip), std::sin(a) * std::sin(tip));
            ring.push_back({at + 0.83f * radius * p, 0.035f * radius});
        }
        model.add(material.gold, tube(ring, 8, 180));
    }
}

void addCockpit(Model& model, const ShipMaterials& material) {
    const glm::vec3 at(1.75f, 0.08f, 0);
    model.add(material.hull, reversed(ellipsoid(at, {0.86f, 0.43f, 0.56f}, 64)));
    const auto box = [&](int m, const glm::vec3& size, const glm::vec3& centre, float lean) {
        model.add(m, placed(roundedBox(size, 0.03f, 2), glm::rotate(glm::translate(glm::mat4(1), at + centre), lean, {0, 0, 1})));
    };
    for (float side : {-0.21f, 0.21f}) {
        box(material.leather, {0.30f, 0.08f, 0.26f}, {-0.15f, -0.20f, side}, 0.1f);
        box(material.leather, {0.08f, 0.38f, 0.26f}, {-0.34f, -0.02f, side}, 0.25f);
        box(material.leather, {0.07f, 0.10f, 0.16f}, {-0.41f, 0.20f, side * 0.95f}, 0.25f);
    }
    box(material.dark, {0.16f, 0.18f, 0.62f}, {0.36f, -0.17f, 0}, -0.5f);
    for (int i = 0; i < 5; ++i) box(material.panel, {0.02f, 0.05f, 0.07f}, {0.272f, -0.14f, -0.22f + 0.11f * float(i)}, -0.5f);
    box(material.dark, {0.9f, 0.03f, 0.6f}, {-0.02f, -0.305f, 0}, 0);
}

void addEngines(Model& model, const ShipMaterials& material) {
    // Filaments of plasma run through the glass from the reactor to the tail.
    for (int k = 0; k < 5; ++k) {
        const float z = 0.16f * float(k - 2), y = 0.10f * std::cos(2.2f * float(k));
        const Station path[] = {{{-1.30f, 0.5f * y, 0.6f * z}, 0.016f},
                                {{-2.0f, 1.6f * y, 1.7f * z}, 0.022f},
                                {{-2.7f, y, 1.5f * z}, 0.020f},
                                {{-3.3f, 0.4f * y, 0.8f * z}, 0.016f}};
        model.add(material.plasma, limb(path, 6, 6));
    }
    // A collar around the tail carries two bells.
    const float along = -0.86f;
    std::vector<Station> collar;
    for (int i = 0; i <= 40; ++i)
        collar.push_back(
            {hullAt(along, 2 * pi * float(i) / 40, 1.0f) + glm::vec3(0, 0.09f * std::sin(2 * pi * float(i) / 40), 0.09f * std::cos(2 * pi * float(i) / 40)),
             0.065f});
    model.add(material.steel, tube(collar, 12, 180));
    for (float side : {-1.0f, 1.0f}) {
        const glm::vec2 bell[] = {{0.16f, 0.46f},  {0.27f, 0.46f},  {0.30f, 0.40f},  {0.27f, 0.05f}, {0.34f, -0.30f},
                                  {0.40f, -0.46f}, {0.38f, -0.47f}, {0.31f, -0.30f}, {0.22f, 0.02f}, {0.20f, 0.10f}};
        const glm::mat4 at = glm::rotate(glm::translate(glm::mat4(1), {-3.42f, 0, side * 1.40f}), -pi / 2, {0, 0, 1});
        model.add(material.steel, placed(turned(smoothCurve(bell, 3), 32), at));
        model.add(material.gold, placed(turned(std::vector<glm::vec2>{{0.315f, -0.02f}, {0.335f, -0.05f}, {0.315f, -0.08f}}, 32, 80), at));
        const glm::vec2 cap[] = {{0, 0.56f}, {0.10f, 0.54f}, {0.16f, 0.46f}};
        model.add(material.steel, placed(turned(cap, 24), at));
        const glm::vec2 fire[] = {{0, 0.06f}, {0.21f, 0.06f}};
        model.add(material.plasma, placed(reversed(turned(fire, 16)), at));
        model.add(material.steel, bar({-3.27f, 0, side * 0.90f}, {-3.35f, 0, side * 1.20f}, 0.07f, 10));
    }
}

/// Blades of glass in sockets of metal that keep them off the hull.
void addWings(Model& model, const ShipMaterials& material) {
    const auto blade = [](float span, float chord) {
        return bent(
            roundedBox({chord, 0.09f, span}, 0.043f, 4, Axis::x, 10),
            [&](const glm::vec3& p) {
                const float t = (p.z + span / 2) / span, shrink = 1 - 0.62f * t;
                return glm::vec3(p.x * shrink - 0.75f * chord * t, p.y * (1 - 0.35f * t) + 0.10f * span * t * t, p.z + span / 2);
            },
            60);
    };
    for (float side : {-1.0f, 1.0f}) {
        const float x = -1.25f, root = shipGirth(x).y;
        // The tips hang: from above the blades are seen from their broad side.
        const glm::mat4 socket = glm::rotate(glm::translate(glm::scale(glm::mat4(1), {1, 1, side}), {x, 0, root + 0.13f}), 0.48f, {1, 0, 0});
        model.add(material.gold, placed(roundedBox({1.66f, 0.16f, 0.14f}, 0.06f, 3), socket));
        model.add(material.wing, placed(blade(1.75f, 1.6f), socket * glm::translate(glm::mat4(1), {0, 0, 0.075f})));
    }
    const float x = -2.25f, top = shipGirth(x).x;
    const glm::mat4 upright = glm::rotate(glm::translate(glm::mat4(1), {x, top + 0.19f, 0}), -pi / 2, {1, 0, 0});
    model.add(material.gold, placed(roundedBox({1.10f, 0.14f, 0.14f}, 0.06f, 3), {x, top + 0.115f, 0}));
    model.add(material.wing, placed(blade(1.0f, 1.0f), upright));
}

}  // namespace

glm::vec2 shipGirth(float x) {
    const float t = std::clamp(x / halfLength, -1.0f, 1.0f);
    return 1.15f * std::sqrt(1 - t * t) * (1 - 0.25f * t) * glm::vec2(0.98f, 1.20f);
}

Model glassShip(const ShipMaterials& material) {
    Model model{"ship", {}};
    model.add(material.hull, hull());
    addSkeleton(model, material);
    addReactor(model, material, {-0.45f, 0, 0}, 0.64f, material.amber);
    for (float side : {-1.0f, 1.0f}) addReactor(model, material, {-1.95f, 0, side * 0.86f}, 0.30f, material.violet);
    addCockpit(model, material);
    addEngines(model, material);
    addWings(model, material);
    return model;
}

}  // namespace lodestir::generate
