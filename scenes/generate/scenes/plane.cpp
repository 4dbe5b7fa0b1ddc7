// SPDX-License-Identifier: MIT
// A toy racing aeroplane of two mirrored halves that wear one half of a picture, joined along the line x = 0.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "kit/backdrop.h"
#include "kit/glb.h"
#include "kit/noise.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/wood.h"

namespace lodestir::generate {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// A rectangle of the picture, with a margin to its neighbours.
struct Chart {
    glm::vec2 low, high;
    glm::vec2 at(float u, float v) const { return low + (high - low) * (0.015f + 0.97f * glm::vec2(u, v)); }
    bool holds(const glm::vec2& p) const { return glm::all(glm::greaterThanEqual(p, low)) && glm::all(glm::lessThan(p, high)); }
    glm::vec2 within(const glm::vec2& p) const { return ((p - low) / (high - low) - 0.015f) / 0.97f; }
};

constexpr Chart fuselageChart{{0, 0}, {1, 0.42f}}, wingChart{{0, 0.42f}, {0.62f, 1}}, tailChart{{0.62f, 0.42f}, {1, 0.66f}},
    finChart{{0.62f, 0.66f}, {0.82f, 0.84f}}, canopyChart{{0.82f, 0.66f}, {1, 0.84f}}, wheelChart{{0.62f, 0.84f}, {1, 1}};

/// A part of the right half over [0,1]^2, in its chart.
Mesh part(int columns, int rows, const Chart& chart, const std::function<glm::vec3(float, float)>& at) {
    Mesh mesh = grid(columns, rows, [&](float u, float v) {
        const glm::vec3 p = at(u, v);
        return glm::vec3(std::abs(p.x) < 1e-6f ? 0 : p.x, p.y, p.z);  // halves meet bit for bit
    });
    for (Vertex& v : mesh.vertices) v.uv = chart.at(v.uv.x, v.uv.y);
    return mesh;
}

/// Radius of the fuselage from spinner (0) to tail (1).
float girth(float t) {
    const glm::vec2 control[] = {{0, 0},          {0.010f, 0.045f}, {0.035f, 0.095f}, {0.075f, 0.13f}, {0.085f, 0.185f},
                                 {0.10f, 0.215f}, {0.16f, 0.235f},  {0.235f, 0.238f}, {0.25f, 0.226f}, {0.40f, 0.235f},
                                 {0.60f, 0.18f},  {0.80f, 0.10f},   {0.95f, 0.045f},  {1, 0}};
    std::size_t i = 1;
    while (i + 1 < std::size(control) && control[i].x < t) ++i;
    const float x = (t - control[i - 1].x) / (control[i].x - control[i - 1].x);
    return glm::mix(control[i - 1].y, control[i].y, x * x * (3 - 2 * x) * 0.6f + 0.4f * x);
}

/// The middle of the fuselage sinks a little towards its tail's top line.
float spine(float t) { return 0.07f * glm::smoothstep(0.3f, 1.0f, t); }

Mesh fuselage() {
    return part(150, 44, fuselageChart, [](float u, float v) {
        const float t = u * u * 0.35f + u * 0.65f, phi = v * pi, r = girth(t);
        const float flute =
            t > 0.09f && t < 0.24f ? 0.006f * std::cos(phi * 16) * glm::smoothstep(0.09f, 0.12f, t) * glm::smoothstep(0.24f, 0.2f, t) : 0;
        return glm::vec3((v == 0 || v == 1 ? 0 : std::sin(phi)) * (r + flute) * 0.92f, spine(t) + std::cos(phi) * (r + flute),
                         1.05f - 2.3f * t);
    });
}

/// Half thickness of a wing section at a share of its chord (NACA four-digit form, Jacobs 1933, closed at the trailing edge).
float section(float x) {
    return 5 * (0.2969f * std::sqrt(x) - 0.1260f * x - 0.3516f * x * x + 0.2843f * x * x * x - 0.1036f * x * x * x * x);
}

struct Wing {
    float span, rootChord, tipChord, thickness, sweep, dihedral;
    glm::vec3 root;
};

/// A closed section swept outward from inside the fuselage; u runs out, v from the trailing edge over the top and back below.
Mesh wing(const Wing& w, const Chart& chart, int columns, int rows) {
    return part(columns, rows, chart, [&](float u, float v) {
        const float s = 1 - (1 - u) * (1 - u) * 0.25f - (1 - u) * 0.75f, tip = std::sqrt(std::max(0.0f, 1 - std::pow(s, 6.0f)));
        const float chord = glm::mix(w.rootChord, w.tipChord, s) * (0.25f + 0.75f * tip), x = 0.5f + 0.5f * std::cos(2 * pi * v);
        const float side = v < 0.5f ? 1.0f : -1.0f, y = v == 0 || v == 1 ? 0 : side * section(x) * w.thickness * chord * tip;
        return w.root + glm::vec3(s * w.span, s * w.dihedral + y, -s * w.sweep + (0.35f - x) * chord);
    });
}

Mesh fin() {
    return part(30, 30, finChart, [](float u, float v) {
        const float s = 1 - v, tip = std::sqrt(std::max(0.0f, 1 - std::pow(s, 5.0f)));
        const float chord = glm::mix(0.40f, 0.22f, s) * (0.3f + 0.7f * tip), x = 0.5f - 0.5f * std::cos(pi * u);
        return glm::vec3(section(x) * 0.13f * chord * tip * (u == 0 || u == 1 ? 0.0f : 1.0f), 0.02f + 0.44f * s,
                         -0.78f - 0.16f * s + (0.4f - x) * chord);
    });
}

/// A blister of glass: half an ellipsoid that tapers to the rear.
Mesh canopy() {
    return part(30, 24, canopyChart, [](float u, float v) {
        const float theta = pi * u, phi = 0.5f * pi * v, r = u == 0 || u == 1 ? 0 : std::sin(theta);
        const float taper = std::cos(theta) < 0 ? 1.5f : 1.0f;
        return glm::vec3((v == 0 ? 0 : std::sin(phi)) * r * 0.13f, 0.13f + std::cos(phi) * r * 0.20f,
                         0.12f + std::cos(theta) * 0.22f * taper);
    });
}

/// A wheel in its teardrop fairing, and its leg.
Mesh undercarriage() {
    Mesh mesh = part(40, 28, wheelChart, [](float u, float v) {
        const float theta = pi * u, phi = 2 * pi * v,
                    drop = std::sin(theta) * (std::cos(theta) < 0 ? 0.62f + 0.38f * (1 + std::cos(theta)) : 1.0f);
        return glm::vec3(0.42f + 0.062f * drop * std::sin(phi), -0.40f + 0.10f * drop * std::cos(phi), 0.30f + 0.25f * std::cos(theta));
    });
    Mesh leg = part(12, 20, wheelChart, [](float u, float v) {
        const float phi = 2 * pi * v;
        return glm::mix(glm::vec3(0.26f, -0.02f, 0.28f), glm::vec3(0.42f, -0.38f, 0.30f), u) +
               glm::vec3(0.016f * std::sin(phi), 0, 0.045f * std::cos(phi));
    });
    for (Vertex& v : leg.vertices) v.uv = wheelChart.at(0.02f + 0.2f * wheelChart.within(v.uv).x, 0.02f + 0.2f * wheelChart.within(v.uv).y);
    append(mesh, leg);
    return mesh;
}

/// The tail skid, on the line itself.
Mesh skid() {
    Mesh mesh = part(8, 10, wheelChart, [](float u, float v) {
        const float phi = pi * v, r = 0.018f * (1 - 0.3f * u);
        return glm::mix(glm::vec3(0, 0.05f, -1.0f), glm::vec3(0, -0.18f, -1.09f), u) +
               glm::vec3(v == 0 || v == 1 ? 0.0f : r * std::sin(phi), 0, r * std::cos(phi));
    });
    for (Vertex& v : mesh.vertices)
        v.uv = wheelChart.at(0.02f + 0.1f * wheelChart.within(v.uv).x, 0.8f + 0.15f * wheelChart.within(v.uv).y);
    return mesh;
}

/// Lacquer in cream and red with panel lines and rivets; spinner and cowling are metal, the canopy is dark.
Surface livery(const glm::vec2& p, const Noise& noise) {
    const glm::vec3 red(0.50f, 0.016f, 0.012f), cream(0.78f, 0.70f, 0.54f), steel(0.62f, 0.61f, 0.59f), gold(0.86f, 0.56f, 0.22f);
    const auto edge = [](float x, float width) { return glm::smoothstep(-width, width, x); };
    const auto line = [](float x, float width) { return std::exp(-x * x / (width * width)); };
    Surface s;
    s.color = red;
    s.roughness = 0.14f;
    float seam = 0;
    if (fuselageChart.holds(p)) {
        const glm::vec2 q = fuselageChart.within(p);
        const float t = q.x * q.x * 0.35f + q.x * 0.65f, cheat = q.y - 0.46f + 0.10f * glm::smoothstep(0.3f, 1.0f, t);
        s.color = glm::mix(red, cream, edge(cheat, 0.004f));
        s.color = glm::mix(s.color, gold, line(cheat, 0.010f));
        const float metal = edge(0.088f - t, 0.002f);
        s.color = glm::mix(s.color, steel, metal);
        s.metalness = std::max(metal, line(cheat, 0.010f));
        s.roughness = glm::mix(0.14f, 0.24f, metal);
        for (float at : {0.245f, 0.42f, 0.60f, 0.78f}) seam = std::max(seam, line(t - at, 0.0022f));
    } else if (wingChart.holds(p) || tailChart.holds(p)) {
        const Chart& chart = wingChart.holds(p) ? wingChart : tailChart;
        const glm::vec2 q = chart.within(p);
        const float out = q.x, band = std::max(edge(out - 0.86f, 0.006f), edge(0.52f - out, 0.006f) * edge(out - 0.44f, 0.006f));
        s.color = glm::mix(red, cream, band);
        const glm::vec2 middle((out - 0.66f) * 1.9f, q.y - 0.25f);  // a roundel on the upper side
        const float r = glm::length(middle);
        if (wingChart.holds(p)) {
            s.color = glm::mix(s.color, cream, edge(0.115f - r, 0.004f));
            s.color = glm::mix(s.color, glm::vec3(0.02f, 0.05f, 0.16f), edge(0.085f - r, 0.004f));
            s.color = glm::mix(s.color, gold, edge(0.035f - r, 0.004f));
        }
        for (float at : {0.25f, 0.62f, 0.80f}) seam = std::max(seam, line(out - at, 0.0035f));
        seam = std::max(seam, std::max(line(q.y - 0.11f, 0.004f), line(q.y - 0.89f, 0.004f)) * edge(out - 0.25f, 0.002f));
    } else if (finChart.holds(p)) {
        const glm::vec2 q = finChart.within(p);
        s.color = glm::mix(red, cream, edge(0.28f - q.y, 0.01f));
        seam = line(q.x - 0.68f, 0.010f);
    } else if (canopyChart.holds(p)) {
        const glm::vec2 q = canopyChart.within(p);
        const float frame = std::max({line(q.x - 0.34f, 0.02f), line(q.x - 0.66f, 0.02f), edge(q.y - 0.86f, 0.02f), line(q.y, 0.035f)});
        s.color = glm::mix(glm::vec3(0.012f, 0.016f, 0.02f), steel, frame);
        s.metalness = frame;
        s.roughness = glm::mix(0.03f, 0.25f, frame);
    } else {
        const glm::vec2 q = wheelChart.within(p);
        s.color = glm::mix(red, cream, edge(q.x - 0.55f, 0.006f));
    }
    s.color *= (1 - 0.75f * seam) * (1 + 0.04f * noise.fractal(glm::vec3(p * 60.0f, 0.5f), 3));
    s.roughness += 0.25f * seam;
    return s;
}

Glb makePlane() {
    Glb glb;
    Mesh half = fuselage();
    append(half, wing({1.25f, 0.62f, 0.34f, 0.14f, 0.10f, 0.16f, {0, -0.09f, 0.22f}}, wingChart, 72, 64));
    append(half, wing({0.50f, 0.32f, 0.20f, 0.11f, 0.08f, 0.02f, {0, 0.09f, -0.86f}}, tailChart, 36, 40));
    append(half, fin());
    append(half, canopy());
    append(half, undercarriage());
    append(half, skid());
    Mesh whole = half;
    append(whole, placed(half, glm::scale(glm::mat4(1), {-1, 1, 1})));
    computeNormals(whole, 50);

    Model plane{"plane", {}};
    const Noise noise{17};
    plane.add(glb.addMaterial(glb.dressed({.name = "livery"}, paint({.width = 2048, .height = 2048, .repeats = false, .smooth = true},
                                                                    [&](const glm::vec2& p) { return livery(p, noise); }))),
              whole);
    const int blades = glb.addMaterial({.name = "blades", .color = {0.10f, 0.06f, 0.03f}, .roughness = 0.25f});
    const Placement parked{.translation = {0, 0.42f, 0}, .rotation = turnY(-34) * glm::angleAxis(glm::radians(-13.0f), glm::vec3(1, 0, 0))};
    glb.addNode(plane, parked);

    // The propeller stands still, so that nothing but the level changes.
    Model propeller{"propeller", {}};
    Mesh blade = grid(8, 40, [](float u, float v) {
        const float s = 2 * v - 1, reach = std::abs(s),
                    width = 0.055f * std::sqrt(std::max(0.0f, 1 - std::pow(reach, 4.0f))) * (0.45f + 0.55f * std::min(1.0f, reach * 3));
        const float twist = (0.9f - 0.5f * reach) * (s < 0 ? -1.0f : 1.0f), x = (2 * u - 1) * width;
        return glm::vec3(x * std::cos(twist), s * 0.46f, 0.985f + x * std::sin(twist));
    });
    Mesh back = blade;
    for (size_t i = 0; i < back.indices.size(); i += 3) std::swap(back.indices[i + 1], back.indices[i + 2]);
    append(blade, placed(back, glm::vec3(0, 0, -0.008f)));
    computeNormals(blade, 60);
    propeller.add(blades, placed(blade, glm::rotate(glm::mat4(1), 0.5f, {0, 0, 1})));
    glb.addNode(propeller, parked);

    addTable(glb,
             {.size = {6.4f, 0.1f, 4.6f}, .edge = 0.02f, .centre = {0, -0.05f, -0.2f}, .grain = 0.45f, .material = "walnut", .wood = walnut(), .seed = 21});
    addWall(glb, {.name = "plaster", .color = {0.42f, 0.46f, 0.50f}, .roughness = 0.95f}, {-9, 6, -3.2f}, {18, 0, 0}, {0, -9, 0});
    return glb;
}

}  // namespace

LODESTIR_SCENE(makePlane, "--levels 4 --ratio 4 --mesh plane")

}  // namespace lodestir::generate
