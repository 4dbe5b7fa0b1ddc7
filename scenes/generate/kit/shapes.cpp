// SPDX-License-Identifier: MIT
// Basic solids: see shapes.h.
#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;

/// Joins a lattice of (columns+1) x (rows+1) vertices, stored row by row, into outward quads.
void stitch(Mesh& mesh, int columns, int rows) {
    const auto stride = uint32_t(columns + 1);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const uint32_t a = uint32_t(y) * stride + uint32_t(x);
            mesh.quad(a, a + stride, a + stride + 1, a + 1);
        }
}

}  // namespace

Mesh grid(int columns, int rows, const std::function<glm::vec3(float, float)>& at) {
    Mesh mesh;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x) {
            const glm::vec2 uv(float(x) / float(columns), float(y) / float(rows));
            mesh.add({.position = at(uv.x, uv.y), .uv = uv});
        }
    stitch(mesh, columns, rows);
    computeNormals(mesh, 180);
    return mesh;
}

Mesh rectangle(const glm::vec3& corner, const glm::vec3& right, const glm::vec3& down) {
    return grid(1, 1, [&](float u, float v) { return corner + right * u + down * v; });
}

namespace {

struct Face {
    glm::vec3 right, up;
};
/// The faces of a box: seen from outside, right x up is the outward normal.
constexpr Face boxFaces[6] = {{{1, 0, 0}, {0, 1, 0}}, {{-1, 0, 0}, {0, 1, 0}}, {{0, 0, -1}, {0, 1, 0}},
                              {{0, 0, 1}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, -1}}, {{1, 0, 0}, {0, 0, 1}}};

}  // namespace

Mesh plainBox(const glm::vec3& size) {
    Mesh mesh;
    for (const Face& face : boxFaces) {
        const glm::vec3 right = face.right * size, up = face.up * size, out = glm::cross(face.right, face.up) * size;
        Mesh side = rectangle((out - right + up) * 0.5f, right, -up);
        scaleUv(side, {glm::length(right), glm::length(up)});
        append(mesh, side);
    }
    return mesh;
}

Mesh roundedBox(const glm::vec3& size, float radius, int segments, Axis grain, int divisions) {
    const glm::vec3 half = size * 0.5f;
    radius = std::min({radius, half.x, half.y, half.z});
    const glm::vec3 core = half - radius;

    Mesh mesh;
    for (const Face& face : boxFaces) {
        const glm::vec3 normal = glm::cross(face.right, face.up);
        const float halfRight = glm::dot(glm::abs(face.right), half), halfUp = glm::dot(glm::abs(face.up), half);
        const bool turn = std::abs(face.up[int(grain)]) > 0.5f;

        // Lattice lines bunch in the rounded rims, of which each face carries its half. The tangent spaces them evenly on the arc.
        const int last = 2 * segments + divisions;
        const auto line = [&](int i, float extent) {
            if (i > segments && i < last - segments) return (extent - radius) * (2 * float(i - segments) / float(divisions) - 1);
            const float step = float(i <= segments ? segments - i : i - (last - segments)) / float(segments);
            const float reach = (extent - radius) + radius * std::tan(step * tau / 8);
            return i <= segments ? -reach : reach;
        };
        const auto base = uint32_t(mesh.vertices.size());
        for (int y = 0; y <= last; ++y)
            for (int x = 0; x <= last; ++x) {
                const glm::vec3 cube =
                    face.right * line(x, halfRight) - face.up * line(y, halfUp) + normal * glm::dot(glm::abs(normal), half);
                const glm::vec3 inner = glm::clamp(cube, -core, core);
                const glm::vec3 out = glm::normalize(cube - inner);
                const glm::vec3 p = inner + out * radius;
                const float along = glm::dot(face.right, cube), up = glm::dot(face.up, cube);
                mesh.add({.position = p, .normal = out, .uv = turn ? glm::vec2(up, along) : glm::vec2(along, -up)});
            }
        const auto stride = uint32_t(last + 1);
        for (int y = 0; y < last; ++y)
            for (int x = 0; x < last; ++x) {
                const uint32_t a = base + uint32_t(y) * stride + uint32_t(x);
                mesh.quad(a, a + stride, a + stride + 1, a + 1);
            }
    }
    return mesh;
}

glm::vec3 sphereDirection(const glm::vec2& uv) {
    const float phi = uv.x * tau, theta = uv.y * tau / 2;
    return {std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)};
}

Mesh sphere(int columns, int rows) {
    Mesh mesh;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x) {
            const glm::vec2 uv(float(x) / float(columns), float(y) / float(rows));
            // The seam and the poles are exact, so that the surface is closed bit for bit.
            const glm::vec3 d = y == 0      ? glm::vec3(0, 1, 0)
                                : y == rows ? glm::vec3(0, -1, 0)
                                            : sphereDirection({x == columns ? 0 : uv.x, uv.y});
            mesh.add({.position = d, .normal = d, .uv = uv});
        }
    const auto stride = uint32_t(columns + 1);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const uint32_t a = uint32_t(y) * stride + uint32_t(x);
            if (y + 1 < rows) mesh.triangle(a, a + stride, a + stride + 1);
            if (y > 0) mesh.triangle(a, a + stride + 1, a + 1);
        }
    return mesh;
}

Mesh turned(std::span<const glm::vec2> profile, int columns, float creaseDegrees) {
    std::vector<float> length(profile.size(), 0.0f);
    for (size_t i = 1; i < profile.size(); ++i) length[i] = length[i - 1] + glm::distance(profile[i - 1], profile[i]);

    Mesh mesh;
    for (size_t y = 0; y < profile.size(); ++y)
        for (int x = 0; x <= columns; ++x) {
            const float u = float(x) / float(columns), phi = (x == columns ? 0 : u) * tau;
            const glm::vec3 p(profile[y].x * std::sin(phi), profile[y].y, profile[y].x * std::cos(phi));
            mesh.add({.position = p, .uv = {u, length[y] / length.back()}});
        }
    stitch(mesh, columns, int(profile.size()) - 1);
    computeNormals(mesh, creaseDegrees);
    return mesh;
}

Mesh tube(std::span<const Station> stations, int sides, float creaseDegrees) {
    // A frame carried along without twist: each step removes what leaned into the new direction.
    std::vector<Station> rings(stations.begin(), stations.end());
    rings.insert(rings.begin(), {stations.front().position, 0.0f});
    rings.push_back({stations.back().position, 0.0f});

    Mesh mesh;
    glm::vec3 side(0);
    float travelled = 0;
    const size_t last = rings.size() - 1;
    for (size_t i = 0; i <= last; ++i) {
        // The caps share a position with their neighbours: look past them for a direction.
        const glm::vec3 from = rings[i <= 1 ? 1 : i - 1].position, to = rings[i >= last - 1 ? last - 1 : i + 1].position;
        const glm::vec3 along = glm::normalize(to == from ? rings[last - 1].position - rings[1].position : to - from);
        side -= along * glm::dot(side, along);
        // The first, and one that a bend turns into the tube's own direction.
        if (glm::dot(side, side) < 1e-8f) side = glm::cross(std::abs(along.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0), along);
        side = glm::normalize(side);
        const glm::vec3 front = glm::cross(along, side);
        if (i > 0) travelled += glm::distance(rings[i - 1].position, rings[i].position) + std::abs(rings[i].radius - rings[i - 1].radius);
        for (int x = 0; x <= sides; ++x) {
            const float phi = (x == sides ? 0.0f : float(x) / float(sides)) * tau;
            const glm::vec3 p = rings[i].position + rings[i].radius * (side * std::sin(phi) + front * std::cos(phi));
            const float girth = tau * std::max(stations.front().radius, stations.back().radius);
            mesh.add({.position = p, .uv = {float(x) / float(sides) * girth, travelled}});
        }
    }
    stitch(mesh, sides, int(last));
    computeNormals(mesh, creaseDegrees);
    return mesh;
}

Mesh bar(const glm::vec3& from, const glm::vec3& to, float radius, int sides) {
    const Station stations[] = {{from, radius}, {to, radius}};
    return tube(stations, sides);
}

std::vector<glm::vec2> smoothCurve(std::span<const glm::vec2> points, int steps) {
    std::vector<glm::vec2> curve;
    const auto at = [&](int i) { return points[size_t(std::clamp(i, 0, int(points.size()) - 1))]; };
    for (int i = 0; i + 1 < int(points.size()); ++i)
        for (int k = 0; k < steps; ++k) {
            const float t = float(k) / float(steps);
            const glm::vec2 a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
            const glm::vec2 p =
                0.5f * (2.0f * b + (c - a) * t + (2.0f * a - 5.0f * b + 4.0f * c - d) * t * t + (3.0f * b - a - 3.0f * c + d) * t * t * t);
            curve.push_back({std::max(p.x, 0.0f), p.y});
        }
    curve.push_back(points.back());
    return curve;
}

Mesh cushion(const glm::vec3& size, int segments) {
    // A grid per side; thickness falls to zero at the rim like a stuffed case, and the outline pulls in between the corners.
    Mesh mesh;
    const auto lens = [&](float side) {
        return grid(segments, segments, [&, side](float u, float v) {
            const glm::vec2 c(2 * u - 1, 2 * v - 1);
            const glm::vec2 pinch = 1.0f - 0.07f * glm::vec2(1 - c.y * c.y, 1 - c.x * c.x);
            const float fill = std::pow(std::max((1 - c.x * c.x) * (1 - c.y * c.y), 0.0f), 0.38f);
            return glm::vec3(c.x * pinch.x * size.x * side, fill * size.y * side, c.y * pinch.y * size.z) * 0.5f;
        });
    };
    append(mesh, lens(1));
    append(mesh, lens(-1));
    computeNormals(mesh, 75);
    return mesh;
}

}  // namespace lodestir::generate
