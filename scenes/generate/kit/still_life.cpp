// SPDX-License-Identifier: MIT
// Pieces of small still lifes: see still_life.h.
#include "still_life.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "shapes.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;

}  // namespace

Model chamber(const Chamber& shape, const ChamberPaints& paints) {
    const float l = -shape.halfWidth, r = shape.halfWidth, h = shape.height, b = shape.back, f = shape.front;
    Model room{"chamber", {}};
    room.add(paints.floor, rectangle({l, 0, b}, {r - l, 0, 0}, {0, 0, f - b}));
    room.add(paints.ceiling, rectangle({l, h, f}, {r - l, 0, 0}, {0, 0, b - f}));
    room.add(paints.back, rectangle({l, h, b}, {r - l, 0, 0}, {0, -h, 0}));
    room.add(paints.front, rectangle({r, h, f}, {l - r, 0, 0}, {0, -h, 0}));
    room.add(paints.left, rectangle({l, h, f}, {0, 0, b - f}, {0, -h, 0}));
    room.add(paints.right, rectangle({r, h, b}, {0, 0, f - b}, {0, -h, 0}));
    return room;
}

Material matt(const std::string& name, const glm::vec3& color) { return {.name = name, .color = color, .ior = 1}; }

Material glow(const std::string& name, const glm::vec3& radiance) {
    return {.name = name, .color = glm::vec3(0), .emission = radiance, .ior = 1};
}

Mesh panel(const glm::vec3& centre, const glm::vec3& facing, const glm::vec2& size) {
    const glm::vec3 front = glm::normalize(facing), pole = std::abs(front.y) > 0.99f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    const glm::vec3 right = glm::normalize(glm::cross(pole, front)), up = glm::cross(front, right);
    return rectangle(centre - right * (size.x / 2) + up * (size.y / 2), right * size.x, -up * size.y);
}

Model areaLamp(const std::string& name, int glowing, int tray, const glm::vec3& centre, const glm::vec3& facing, const glm::vec2& size) {
    Model lamp{name, {}};
    lamp.add(glowing, panel(centre, facing, size));
    const glm::vec3 front = glm::normalize(facing), pole = std::abs(front.y) > 0.99f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    const glm::vec3 right = glm::normalize(glm::cross(pole, front)), up = glm::cross(front, right);
    const glm::mat4 stand(glm::vec4(right, 0), glm::vec4(up, 0), glm::vec4(front, 0), glm::vec4(centre - front * 0.025f, 1));
    lamp.add(tray, placed(plainBox({size.x + 0.06f, size.y + 0.06f, 0.04f}), stand));
    return lamp;
}

Mesh faceted(Mesh mesh) {
    computeNormals(mesh, 0.01f);
    return mesh;
}

Mesh gem(int sides) {
    const glm::vec2 profile[] = {{0, 0.62f}, {0.55f, 0.62f}, {1, 0.18f}, {0.96f, 0.02f}, {0, -1}};
    return faceted(turned(profile, sides));
}

Mesh lathe(std::span<const glm::vec2> control, int steps, int columns) {
    std::vector<glm::vec2> profile = smoothCurve(control, steps);
    for (glm::vec2& p : profile) p.y = std::max(p.y, 0.0f);  // the curve overshoots where it turns into the foot
    return turned(profile, columns, 60);
}

Mesh jug(int columns) {
    const glm::vec2 control[] = {{0, 0.08f},      {0.24f, 0.12f}, {0.31f, 0.38f}, {0.15f, 0.76f}, {0.19f, 0.99f}, {0.205f, 1},
                                 {0.215f, 0.98f}, {0.18f, 0.76f}, {0.345f, 0.4f}, {0.28f, 0.1f},  {0.2f, 0},      {0, 0}};
    return lathe(control, 2, columns);
}

Mesh dish(int columns) {
    const glm::vec2 control[] = {{0, 0.16f},     {0.55f, 0.22f}, {1.05f, 0.62f}, {1.25f, 0.98f}, {1.28f, 1},
                                 {1.29f, 0.97f}, {1.12f, 0.58f}, {0.62f, 0.12f}, {0.5f, 0},      {0, 0}};
    return lathe(control, 2, columns);
}

Mesh knot(int stations, int sides, float thickness) {
    Mesh mesh;
    const auto centre = [](float t) {
        return glm::vec3(std::sin(t) + 2 * std::sin(2 * t), -std::sin(3 * t), std::cos(t) - 2 * std::cos(2 * t)) / 3.0f;
    };
    // A frame from the radius: it turns with the curve and closes where the curve does.
    for (int i = 0; i <= stations; ++i)
        for (int k = 0; k <= sides; ++k) {
            const float t = tau * float(i % stations) / float(stations), phi = tau * float(k % sides) / float(sides);
            const glm::vec3 along = glm::normalize(centre(t + 0.01f) - centre(t - 0.01f));
            const glm::vec3 side = glm::normalize(glm::cross(glm::vec3(0, 1, 0), along)), up = glm::cross(along, side);
            mesh.add({.position = centre(t) + thickness * (std::cos(phi) * side + std::sin(phi) * up),
                      .uv = {float(i) / float(stations), float(k) / float(sides)}});
        }
    for (int i = 0; i < stations; ++i)
        for (int k = 0; k < sides; ++k) {
            const auto a = uint32_t(i * (sides + 1) + k), next = uint32_t(sides + 1);
            mesh.quad(a, a + next, a + next + 1, a + 1);
        }
    computeNormals(mesh, 180);
    return mesh;
}

int Composition::paint(const std::string& name, const glm::vec3& color) { return glb.addMaterial(matt(name, color)); }

int Composition::lamp(const std::string& name, const glm::vec3& radiance) { return glb.addMaterial(glow(name, radiance)); }

int Composition::gloss(const std::string& name, const glm::vec3& color, float roughness, float metalness) {
    return glb.addMaterial({.name = name, .color = color, .roughness = roughness, .metalness = metalness});
}

int Composition::put(const std::string& name, int material, const Mesh& mesh, const Placement& placement) {
    Model model{name, {}};
    model.add(material, mesh);
    return glb.addNode(model, placement);
}

void Composition::block(const std::string& name, int material, const glm::vec3& size, const glm::vec3& ground, float turnDegrees) {
    put(name, material, plainBox(size), {.translation = ground + glm::vec3(0, size.y / 2, 0), .rotation = turnY(turnDegrees)});
}

void Composition::ball(const std::string& name, int material, float radius, const glm::vec3& ground, int columns) {
    put(name, material, sphere(columns, columns / 2), {.translation = ground + glm::vec3(0, radius, 0), .scale = glm::vec3(radius)});
}

}  // namespace lodestir::generate
