// SPDX-License-Identifier: MIT
// Vessels: see tableware.h.
#include "tableware.h"

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "masonry.h"
#include "noise.h"
#include "random.h"
#include "shapes.h"

namespace lodestir::generate {

namespace {

/// A vessel turned from control points that run up the inside, over the rim and down the outside to the foot; UVs in repeats of the glaze.
Mesh vessel(std::span<const glm::vec2> control, float scale, int columns = 44) {
    std::vector<glm::vec2> profile = smoothCurve(control, 4);
    float length = 0, girth = 0;
    for (size_t i = 0; i < profile.size(); ++i) {
        profile[i] *= scale;
        if (i > 0) length += glm::distance(profile[i - 1], profile[i]);
        girth = std::max(girth, 2 * std::numbers::pi_v<float> * profile[i].x);
    }
    Mesh mesh = turned(profile, columns, 60);
    // A whole number of repeats around, so that the glaze has no seam.
    scaleUv(mesh, {std::max(std::round(girth / earthenwareSize), 1.0f), length / earthenwareSize});
    return mesh;
}

}  // namespace

Model bowl(const std::string& name, int material, float radius) {
    const glm::vec2 control[] = {{0, 0.10f},      {0.35f, 0.115f}, {0.72f, 0.27f}, {0.93f, 0.52f}, {0.985f, 0.605f},
                                 {1.0f, 0.61f},   {1.01f, 0.595f}, {0.97f, 0.49f}, {0.78f, 0.21f}, {0.44f, 0.065f},
                                 {0.40f, 0.015f}, {0.37f, 0.0f},   {0.2f, 0.004f}, {0, 0.004f}};
    Model model{name, {}};
    model.add(material, vessel(control, radius));
    return model;
}

Model vase(const std::string& name, int material, float height, float radius) {
    const float r = radius / height;
    const glm::vec2 control[] = {{0, 0.20f},          {r * 0.8f, 0.22f},   {r * 0.88f, 0.45f}, {r * 0.32f, 0.82f}, {r * 0.34f, 0.985f},
                                 {r * 0.40f, 1.0f},   {r * 0.46f, 0.985f}, {r * 0.42f, 0.83f}, {r * 0.97f, 0.48f}, {r * 0.96f, 0.20f},
                                 {r * 0.62f, 0.015f}, {r * 0.55f, 0},      {r * 0.2f, 0.004f}, {0, 0.004f}};
    Model model{name, {}};
    model.add(material, vessel(control, height));
    return model;
}

Model mug(const std::string& name, int material) {
    const glm::vec2 control[] = {{0, 0.10f},    {0.36f, 0.11f},   {0.39f, 0.30f}, {0.40f, 0.95f}, {0.415f, 0.995f},
                                 {0.43f, 1.0f}, {0.445f, 0.985f}, {0.45f, 0.5f},  {0.45f, 0.12f}, {0.40f, 0.01f},
                                 {0.36f, 0.0f}, {0.2f, 0.005f},   {0, 0.005f}};
    Model model{name, {}};
    constexpr float height = 0.088f;
    model.add(material, vessel(control, height, 40));
    std::vector<Station> handle;
    for (int i = 0; i <= 14; ++i) {
        const float a = std::numbers::pi_v<float> * (float(i) / 14 * 1.1f - 0.05f);
        handle.push_back({glm::vec3(0.038f + 0.029f * std::sin(a), height * 0.5f + 0.029f * std::cos(a), 0), 0.0052f});
    }
    Mesh grip = tube(handle, 12);
    scaleUv(grip, glm::vec2(1 / earthenwareSize));
    model.add(material, grip);
    return model;
}

Model pot(const std::string& name, int material, int soil, float height) {
    const glm::vec2 control[] = {{0, 0.80f},      {0.40f, 0.80f}, {0.455f, 0.84f}, {0.475f, 0.985f}, {0.495f, 1.0f}, {0.52f, 0.985f},
                                 {0.515f, 0.86f}, {0.47f, 0.45f}, {0.40f, 0.04f},  {0.37f, 0.0f},    {0.2f, 0.004f}, {0, 0.004f}};
    Model model{name, {}};
    model.add(material, vessel(control, height));
    const Noise noise{9};
    model.add(soil, grid(20, 20, [&](float u, float v) {
                  const glm::vec2 c = glm::vec2(2 * u - 1, 2 * v - 1);
                  // A square mapped to a disc that reaches just into the wall.
                  const glm::vec2 disc = c * glm::sqrt(glm::vec2(1 - c.y * c.y / 2, 1 - c.x * c.x / 2));
                  return height * glm::vec3(disc.x * 0.46f, 0.86f + 0.035f * noise.fractal({c.x * 5, c.y * 5, 0.5f}, 3), disc.y * 0.46f);
              }));
    return model;
}

Model fruit(const std::string& name, int material, uint32_t seed, float bowlRadius) {
    Random random(seed);
    const Noise noise{seed};
    Model model{name, {}};
    struct Seat {
        float ring, turn, y;
    };
    const Seat seats[] = {{0.42f, 0.1f, 0.44f}, {0.45f, 0.36f, 0.45f}, {0.43f, 0.62f, 0.44f}, {0.46f, 0.86f, 0.46f}, {0.05f, 0.3f, 0.80f}};
    for (const Seat& seat : seats) {
        const bool lemon = random.next() < 0.4f;
        const glm::vec3 skin = lemon ? glm::vec3(0.78f, 0.56f, 0.05f) : glm::vec3(0.82f, 0.27f, 0.02f);
        const glm::vec3 stretch = lemon ? glm::vec3(0.86f, 1.18f, 0.86f) : glm::vec3(1.02f, 0.95f, 1.02f);
        Mesh mesh = bent(
            sphere(32, 18),
            [&](const glm::vec3& p) {
                const float tip = lemon ? 0.10f * std::pow(std::abs(p.y), 14.0f) : -0.05f * std::pow(std::max(p.y, 0.0f), 24.0f);
                return p * stretch * (1 + tip + 0.02f * noise.at(p * 2.0f + seat.turn * 9) + 0.006f * noise.at(p * 14.0f));
            },
            180);
        for (Vertex& v : mesh.vertices) v.color = skin * (1 + 0.12f * noise.fractal(v.position * 3.0f + seat.turn * 17, 3));
        mesh.hasColors = true;
        const float a = 6.2831853f * seat.turn, r = bowlRadius * seat.ring;
        glm::mat4 where = glm::translate(glm::mat4(1), glm::vec3(r * std::cos(a), bowlRadius * seat.y, r * std::sin(a)));
        where =
            glm::rotate(where, random.between(0, 6.28f), glm::normalize(glm::vec3(random.bell(), random.bell(), random.bell()) + 0.01f));
        model.add(material, placed(mesh, glm::scale(where, glm::vec3(bowlRadius * 0.31f))));
    }
    return model;
}

}  // namespace lodestir::generate
