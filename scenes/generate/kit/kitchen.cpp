// SPDX-License-Identifier: MIT
// See kitchen.h.
#include "kitchen.h"

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "grip.h"
#include "shapes.h"
#include "slab.h"

namespace lodestir::generate {

namespace {

constexpr float deep = 0.60f, plinth = 0.10f, top = 0.86f, counter = 0.04f;
constexpr float tau = 2 * std::numbers::pi_v<float>;

/// A ring around +y at `height`.
Mesh ring(float radius, float thickness, float height) {
    std::vector<glm::vec2> section;
    for (int i = 0; i <= 14; ++i) {
        const float a = tau * float(i % 14) / 14;
        section.emplace_back(radius + thickness * std::sin(a), height + thickness * std::cos(a));
    }
    return turned(section, 56, 180);
}

Mesh lathed(std::span<const glm::vec2> control, int columns) {
    std::vector<glm::vec2> profile = smoothCurve(control, 5);
    for (glm::vec2& p : profile) p = glm::max(p, glm::vec2(0));  // the curve overshoots where it turns into the foot
    return turned(profile, columns, 50);
}

/// A framed panel on the plane z = 0 between two corners, grip along its upper or its free edge.
void addFront(Model& model, const KitchenPaints& paints, const glm::vec2& low, const glm::vec2& high, bool drawer, float gripX) {
    constexpr float stile = 0.055f, thick = 0.02f, bevel = 0.0025f;
    const auto board = [&](const glm::vec2& a, const glm::vec2& b, float z) { model.add(paints.front, slab({a.x, a.y, 0}, {b.x, b.y, z}, 1, bevel)); };
    const float rail = drawer ? 0.035f : stile;
    board(low, {low.x + stile, high.y}, thick);
    board({high.x - stile, low.y}, high, thick);
    board({low.x + stile - 0.002f, low.y}, {high.x - stile + 0.002f, low.y + rail}, thick - 0.0003f);
    board({low.x + stile - 0.002f, high.y - rail}, {high.x - stile + 0.002f, high.y}, thick - 0.0003f);
    board({low.x + stile - 0.004f, low.y + rail - 0.004f}, {high.x - stile + 0.004f, high.y - rail + 0.004f}, thick * 0.45f);
    const glm::vec3 out(0, 0, 0.032f);
    if (drawer) {
        const float middle = (low.x + high.x) / 2, y = (low.y + high.y) / 2;
        model.add(paints.chrome, grip({middle - 0.08f, y, thick * 0.4f}, {middle + 0.08f, y, thick * 0.4f}, out, 0.006f));
    } else {
        model.add(paints.chrome, grip({gripX, high.y - 0.24f, thick * 0.9f}, {gripX, high.y - 0.08f, thick * 0.9f}, out, 0.006f));
    }
}

void addOven(Model& model, const KitchenPaints& paints, float width) {
    constexpr float low = plinth + 0.03f, high = top - 0.005f, panel = 0.72f;
    model.add(paints.steel, slab({0.002f, panel, 0}, {width - 0.002f, high, 0.02f}, 1, 0.003f));
    model.add(paints.steel, slab({0.002f, low, 0}, {width - 0.002f, panel - 0.004f, 0.016f}, 1, 0.003f));
    model.add(paints.black, slab({0.035f, low + 0.05f, 0.01f}, {width - 0.035f, panel - 0.075f, 0.022f}, 1, 0.002f));
    model.add(paints.chrome, grip({0.08f, panel - 0.04f, 0.014f}, {width - 0.08f, panel - 0.04f, 0.014f}, {0, 0, 0.045f}, 0.009f));
    for (float share : {0.14f, 0.30f, 0.70f, 0.86f})
        model.add(paints.chrome, bar({width * share, 0.787f, 0.018f}, {width * share, 0.787f, 0.045f}, 0.021f, 32));
    model.add(paints.black, slab({width * 0.42f, 0.765f, 0.018f}, {width * 0.58f, 0.81f, 0.0215f}, 1, 0.001f));
}

}  // namespace

Model baseCabinet(const std::string& name, const KitchenPaints& paints, float width, Fronts fronts) {
    Model model{name, {}}, face{"", {}};
    constexpr float gap = 0.002f;
    model.add(paints.carcass, slab({0, plinth, 0}, {width, top, deep - 0.04f}, 1));
    model.add(paints.carcass, slab({0, 0, 0}, {width, plinth, deep - 0.09f}, 1));
    model.add(paints.counter, slab({0, top, 0}, {width, top + counter, deep + 0.01f}, 0.9f, 0.004f));
    if (fronts == Fronts::oven) addOven(face, paints, width);
    if (fronts == Fronts::doors) {
        const float half = width / 2;
        addFront(face, paints, {gap, plinth + 0.01f}, {half - gap, top - 0.006f}, false, half - 0.03f);
        addFront(face, paints, {half + gap, plinth + 0.01f}, {width - gap, top - 0.006f}, false, half + 0.03f);
    }
    if (fronts == Fronts::drawers) {
        const float rows[] = {plinth + 0.01f, 0.37f, 0.64f, top - 0.004f};
        for (int i = 0; i < 3; ++i) addFront(face, paints, {gap, rows[i] + gap}, {width - gap, rows[i + 1] - gap}, true, 0);
    }
    for (const auto& [material, mesh] : face.parts) model.add(material, placed(mesh, {0, 0, deep - 0.04f}));
    return model;
}

Model barStool(const std::string& name, const KitchenPaints& paints) {
    Model model{name, {}};
    const glm::vec2 foot[] = {{0.030f, 0.30f},  {0.031f, 0.14f},  {0.036f, 0.075f}, {0.060f, 0.038f},
                              {0.120f, 0.020f}, {0.190f, 0.010f}, {0.202f, 0.004f}, {0.200f, 0}};
    model.add(paints.chrome, lathed(foot, 64));
    model.add(paints.chrome, bar({0, 0.28f, 0}, {0, 0.60f, 0}, 0.024f, 32));
    model.add(paints.chrome, ring(0.165f, 0.010f, 0.27f));
    for (int i = 0; i < 3; ++i) {
        const float a = tau * float(i) / 3;
        model.add(paints.chrome, bar({0, 0.27f, 0}, {0.160f * std::sin(a), 0.27f, 0.160f * std::cos(a)}, 0.007f, 16));
    }
    const glm::vec2 pan[] = {{0, 0.625f}, {0.170f, 0.625f}, {0.186f, 0.618f}, {0.188f, 0.606f}, {0.150f, 0.594f}, {0.030f, 0.588f}, {0, 0.588f}};
    model.add(paints.chrome, turned(pan, 64));
    const glm::vec2 pad[] = {{0, 0.672f}, {0.10f, 0.674f}, {0.165f, 0.668f}, {0.187f, 0.650f}, {0.184f, 0.628f}, {0.165f, 0.620f}, {0, 0.620f}};
    model.add(paints.leather, lathed(pad, 64));
    return model;
}

Model saucepan(const std::string& name, const KitchenPaints& paints, float radius) {
    Model model{name, {}};
    const float h = radius * 1.15f;
    const glm::vec2 body[] = {{radius * 0.90f, h}, {radius * 0.94f, h + 0.004f}, {radius * 1.02f, h + 0.002f}, {radius, h - 0.006f}, {radius, h * 0.5f},
                              {radius, 0.014f},    {radius * 0.96f, 0.002f},     {radius * 0.9f, 0},            {0, 0}};
    model.add(paints.steel, lathed(body, 64));
    const glm::vec2 lid[] = {{0, h + radius * 0.30f},      {radius * 0.5f, h + radius * 0.25f}, {radius * 0.88f, h + radius * 0.08f},
                             {radius * 0.97f, h + 0.006f}, {radius * 0.98f, h + 0.002f},        {radius * 0.9f, h + 0.001f},
                             {0, h + 0.001f}};
    model.add(paints.chrome, lathed(lid, 64));
    const float y = h + radius * 0.30f;
    const Station knob[] = {{{0, y - 0.004f, 0}, 0.008f},
                            {{0, y + 0.012f, 0}, 0.008f},
                            {{0, y + 0.018f, 0}, 0.020f},
                            {{0, y + 0.024f, 0}, 0.022f},
                            {{0, y + 0.029f, 0}, 0.018f}};
    model.add(paints.black, tube(knob, 28));
    for (float side : {-1.0f, 1.0f})
        model.add(paints.chrome, grip({side * radius, h * 0.72f, -0.04f}, {side * radius, h * 0.72f, 0.04f}, {side * 0.03f, 0.004f, 0}, 0.005f));
    return model;
}

Model bin(const std::string& name, const KitchenPaints& paints, float radius, float height) {
    Model model{name, {}};
    const float r = radius, h = height;
    const glm::vec2 body[] = {{r * 0.9f, h}, {r, h}, {r, h - 0.01f}, {r, 0.03f}, {r * 0.985f, 0.022f}, {0, 0.022f}};
    model.add(paints.chrome, turned(body, 80, 40));
    const glm::vec2 base[] = {{r * 0.9f, 0.03f}, {r * 1.01f, 0.026f}, {r * 1.015f, 0.006f}, {r, 0}, {0, 0}};
    model.add(paints.black, turned(base, 64, 40));
    std::vector<glm::vec2> dome;
    for (int i = 0; i <= 12; ++i) {
        const float a = tau / 4 * float(i) / 12;
        dome.emplace_back(r * 0.99f * std::sin(a), h + 0.012f + r * 0.62f * std::cos(a));
    }
    dome.emplace_back(r * 1.01f, h + 0.010f);
    dome.emplace_back(r * 1.01f, h - 0.004f);
    model.add(paints.chrome, turned(dome, 80, 40));
    return model;
}

}  // namespace lodestir::generate
