// SPDX-License-Identifier: MIT
// Round arches and what carries them: see arcade.h.
#include "arcade.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "shapes.h"

namespace lodestir::generate {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// A turned profile whose UVs are in metres.
Mesh turnedInMetres(std::span<const glm::vec2> profile, int columns) {
    Mesh mesh = turned(profile, columns);
    float length = 0, girth = 0;
    for (size_t i = 1; i < profile.size(); ++i) length += glm::distance(profile[i - 1], profile[i]);
    for (const glm::vec2& p : profile) girth = std::max(girth, 2 * pi * p.x);
    scaleUv(mesh, {girth, length});
    return mesh;
}

/// Points of a bay's opening from its lower left to its lower right, and for each the point of the wall's outline beyond it.
struct Outline {
    std::vector<glm::vec2> opening, wall;
};

Outline outlineOf(const ArchBay& bay) {
    Outline line;
    const float half = bay.width / 2, r = bay.opening / 2, rise = bay.height - bay.spring;
    const auto add = [&](const glm::vec2& inner, const glm::vec2& outer) {
        line.opening.push_back(inner);
        line.wall.push_back(outer);
    };
    add({-r, bay.sill}, {-half, bay.sill});
    // Rays from the middle of the arch; those to the wall's corners are among them.
    std::vector<float> angles;
    for (int i = 0; i <= 24; ++i) angles.push_back(pi * float(i) / 24);
    const float corner = std::atan2(rise, half);
    angles.push_back(corner);
    angles.push_back(pi - corner);
    std::ranges::sort(angles, std::greater());
    for (float a : angles) {
        const glm::vec2 d(std::cos(a), std::sin(a));
        const float reach = std::min(half / std::max(std::abs(d.x), 1e-6f), rise / std::max(d.y, 1e-6f));
        add(glm::vec2(0, bay.spring) + r * d, glm::vec2(0, bay.spring) + reach * d);
    }
    add({r, bay.sill}, {half, bay.sill});
    return line;
}

}  // namespace

Mesh column(float height, float radius) {
    const float r = radius, plinth = 0.35f * r, top = height - 0.3f * r, cap = top - 1.1f * r;
    std::vector<glm::vec2> profile{{1.02f * r, top}, {1.22f * r, top - 0.05f * r}, {1.22f * r, top - 0.14f * r}, {1.12f * r, top - 0.3f * r}};
    // The bell of the capital, then a ring.
    for (int i = 0; i <= 8; ++i) {
        const float t = float(i) / 8;
        profile.push_back({r * (0.86f + 0.24f * std::pow(1 - t, 2.0f)), glm::mix(top - 0.34f * r, cap, t)});
    }
    profile.insert(profile.end(), {{0.95f * r, cap - 0.02f * r}, {0.98f * r, cap - 0.09f * r}, {0.95f * r, cap - 0.16f * r}, {0.85f * r, cap - 0.19f * r}});
    const float foot = plinth + 0.75f * r;
    for (int i = 1; i <= 10; ++i) {
        const float t = float(i) / 10;  // entasis: the shaft is thinner at its head, most of it in the upper half
        profile.push_back({r * (0.85f + 0.15f * std::sin(t * pi / 2)), glm::mix(cap - 0.2f * r, foot, t)});
    }
    const auto torus = [&](float middle, float reach, float thick) {
        for (int i = 0; i <= 6; ++i) {
            const float a = pi / 2 - pi * float(i) / 6;
            profile.push_back({reach - thick + thick * std::cos(a), middle + thick * std::sin(a)});
        }
    };
    torus(foot - 0.10f * r, 1.14f * r, 0.09f * r);
    profile.push_back({1.05f * r, foot - 0.30f * r});
    torus(plinth + 0.16f * r, 1.36f * r, 0.15f * r);
    Mesh mesh = turnedInMetres(profile, 32);
    append(mesh, placed(roundedBox({2.9f * r, plinth, 2.9f * r}, 0.03f * r), {0, plinth / 2, 0}));
    append(mesh, placed(roundedBox({2.6f * r, height - top, 2.6f * r}, 0.04f * r), {0, (height + top) / 2, 0}));
    return mesh;
}

Mesh archBay(const ArchBay& bay) {
    const Outline line = outlineOf(bay);
    const float z = bay.depth / 2;
    Mesh mesh;
    for (float side : {1.0f, -1.0f}) {
        const auto point = [&](const glm::vec2& p) { return mesh.add({.position = {p.x, p.y, side * z}, .uv = {side * p.x, -p.y}}); };
        const auto quad = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) { side > 0 ? mesh.quad(a, b, c, d) : mesh.quad(d, c, b, a); };
        for (size_t i = 0; i + 1 < line.opening.size(); ++i)
            quad(point(line.wall[i]), point(line.opening[i]), point(line.opening[i + 1]), point(line.wall[i + 1]));
        if (bay.sill > 0 && !bay.afloat) {
            const float half = bay.width / 2, r = bay.opening / 2;
            const float xs[] = {-half, -r, r, half};  // the wall's corners and the opening's: no joint without a vertex
            for (int i = 0; i < 3; ++i) quad(point({xs[i], 0}), point({xs[i + 1], 0}), point({xs[i + 1], bay.sill}), point({xs[i], bay.sill}));
        }
    }
    float travelled = 0;
    for (size_t i = 0; i + 1 < line.opening.size(); ++i) {
        const glm::vec2 a = line.opening[i], b = line.opening[i + 1];
        const float next = travelled + glm::distance(a, b);
        const auto point = [&](const glm::vec2& p, float depth, float v) { return mesh.add({.position = {p.x, p.y, depth}, .uv = {depth, v}}); };
        mesh.quad(point(a, z, travelled), point(a, -z, travelled), point(b, -z, next), point(b, z, next));
        travelled = next;
    }
    if (bay.sill > 0 && !bay.afloat) {
        Mesh sill = rectangle({-bay.opening / 2, bay.sill, -z}, {bay.opening, 0, 0}, {0, 0, bay.depth});
        scaleUv(sill, {bay.opening, bay.depth});
        append(mesh, sill);
    }
    computeNormals(mesh, 25);
    return mesh;
}

Mesh archivolt(const ArchBay& bay, float radius) {
    std::vector<Station> stations{{{-bay.opening / 2 - radius, bay.sill, bay.depth / 2}, radius}};
    for (int i = 0; i <= 24; ++i) {
        const float a = pi - pi * float(i) / 24, r = bay.opening / 2 + radius;
        stations.push_back({{r * std::cos(a), bay.spring + r * std::sin(a), bay.depth / 2}, radius});
    }
    stations.push_back({{bay.opening / 2 + radius, bay.sill, bay.depth / 2}, radius});
    return tube(stations, 10);
}

Mesh barrelVault(float radius, float back, float front, int segments) {
    Mesh mesh = grid(segments, 1, [&](float u, float v) {
        const float a = pi * u;
        return glm::vec3(-radius * std::cos(a), radius * std::sin(a), glm::mix(front, back, v));
    });
    scaleUv(mesh, {pi * radius, front - back});
    return mesh;
}

}  // namespace lodestir::generate
