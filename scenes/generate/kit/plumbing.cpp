// SPDX-License-Identifier: MIT
// See plumbing.h.
#include "plumbing.h"

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "shapes.h"

namespace lodestir::generate {

namespace {

/// A disc with a rounded rim, its foot at `foot`.
Mesh disc(const glm::vec3& foot, float radius, float height, float rim) {
    std::vector<glm::vec2> profile{{0, height}};
    for (int i = 0; i <= 4; ++i) {
        const float a = std::numbers::pi_v<float> / 2 * float(i) / 4;
        profile.emplace_back(radius - rim + rim * std::sin(a), height - rim + rim * std::cos(a));
    }
    for (int i = 0; i <= 4; ++i) {
        const float a = std::numbers::pi_v<float> / 2 * float(i) / 4;
        profile.emplace_back(radius - rim + rim * std::cos(a), rim - rim * std::sin(a));
    }
    profile.emplace_back(0, 0);
    return placed(turned(profile, 48, 30), foot);
}

/// A tube along a smooth curve in the plane x = 0 through points (z, y).
Mesh pipe(std::span<const glm::vec2> control, float radius) {
    std::vector<Station> stations;
    for (const glm::vec2& p : smoothCurve(control, 8)) stations.push_back({{0, p.y, p.x}, radius});
    return tube(stations, 24);
}

}  // namespace

Model tap(const std::string& name, int metal, float height, float reach) {
    Model model{name, {}};
    model.add(metal, disc({0, 0, 0}, 0.027f, 0.012f, 0.004f));
    model.add(metal, disc({0, 0.008f, 0}, 0.021f, height * 0.55f, 0.005f));
    const float top = height, rise = height * 0.5f;
    const glm::vec2 spout[] = {{0, rise},           {0, top * 0.8f},          {reach * 0.12f, top * 0.95f}, {reach * 0.5f, top},
                               {reach * 0.88f, top * 0.95f}, {reach, top * 0.8f}, {reach, top * 0.7f}};
    model.add(metal, pipe(spout, 0.0115f));
    const Station lever[] = {{{0.018f, height * 0.42f, 0}, 0.010f}, {{0.034f, height * 0.42f, 0}, 0.010f}, {{0.040f, height * 0.43f, 0}, 0.0045f},
                             {{0.052f, height * 0.62f, 0.004f}, 0.0040f}};
    model.add(metal, tube(lever, 16));
    return model;
}

Model shower(const std::string& name, int metal, float height, float reach) {
    Model model{name, {}};
    constexpr float low = 0.95f, off = 0.05f;  ///< of the thermostat: above the floor, before the wall
    model.add(metal, bar({-0.15f, low, off}, {0.15f, low, off}, 0.022f, 32));
    for (float side : {-1.0f, 1.0f}) {
        model.add(metal, bar({side * 0.115f, low, off}, {side * 0.185f, low, off}, 0.027f, 32));
        const Station rose[] = {{{side * 0.075f, low, 0}, 0.032f}, {{side * 0.075f, low, 0.006f}, 0.032f}, {{side * 0.075f, low, 0.010f}, 0.017f},
                                {{side * 0.075f, low, off}, 0.017f}};
        model.add(metal, tube(rose, 28));
    }
    const glm::vec2 riser[] = {{off, low + 0.01f}, {off, low + 0.4f}, {off, height - 0.12f}, {off + 0.03f, height + 0.015f}, {off + 0.11f, height + 0.05f},
                               {reach - 0.12f, height + 0.05f}, {reach - 0.03f, height + 0.03f}, {reach, height - 0.01f}, {reach, height - 0.05f}};
    model.add(metal, pipe(riser, 0.0105f));
    const Station bracket[] = {{{0, height - 0.25f, 0}, 0.022f}, {{0, height - 0.25f, 0.006f}, 0.022f}, {{0, height - 0.25f, 0.010f}, 0.009f},
                               {{0, height - 0.25f, off}, 0.009f}};
    model.add(metal, tube(bracket, 20));
    model.add(metal, disc({0, height - 0.075f, reach}, 0.125f, 0.012f, 0.005f));
    return model;
}

Model basin(const std::string& name, int enamel, const glm::vec3& size, float square) {
    // Up the inside, over the rim and down to the foot: (share of the radius, share of the height).
    const float wall = 0.055f / std::max(size.x, size.z);
    const glm::vec2 control[] = {{0, 0.10f},          {0.40f, 0.105f}, {0.66f, 0.17f}, {0.80f, 0.45f}, {0.93f - wall, 0.90f}, {0.965f - wall, 0.985f},
                                 {0.99f - wall / 2, 1.0f}, {1.0f, 0.975f},  {0.97f, 0.88f}, {0.90f, 0.45f}, {0.78f, 0.10f},        {0.72f, 0.02f},
                                 {0.66f, 0.0f},       {0.3f, 0.004f},  {0, 0.004f}};
    const Mesh round = turned(smoothCurve(control, 4), 96, 60);
    Model model{name, {}};
    model.add(enamel, bent(
                          round,
                          [&](const glm::vec3& p) {
                              const float r = std::hypot(p.x, p.z);
                              if (r == 0) return glm::vec3(0, p.y * size.y, 0);
                              const glm::vec2 d = glm::vec2(p.x, p.z) / r;
                              const float reach = std::pow(std::pow(std::abs(d.x), square) + std::pow(std::abs(d.y), square), -1 / square);
                              return glm::vec3(0.5f * size.x * r * reach * d.x, p.y * size.y, 0.5f * size.z * r * reach * d.y);
                          },
                          60));
    return model;
}

}  // namespace lodestir::generate
