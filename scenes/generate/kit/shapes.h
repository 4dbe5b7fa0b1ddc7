// SPDX-License-Identifier: MIT
// Basic solids with sensible UVs and no razor-sharp edges: grids, boxes, spheres, turned and swept shapes.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "mesh.h"

namespace lodestir::generate {

/// A surface over [0,1]^2: `at(u, v)` with u to the right and v down when seen from the front. UVs are (u, v). Smooth normals.
Mesh grid(int columns, int rows, const std::function<glm::vec3(float u, float v)>& at);

/// A flat rectangle through its upper-left corner, with edges to the right and down. UVs span [0,1].
Mesh rectangle(const glm::vec3& corner, const glm::vec3& right, const glm::vec3& down);

enum class Axis { x, y, z };

/// A box centred on the origin whose edges are rounded by `radius` with `segments` steps; flats are cut into `divisions` where the box is
/// to be bent. UVs in metres, face by face, u along `grain`.
Mesh roundedBox(const glm::vec3& size, float radius, int segments = 2, Axis grain = Axis::x, int divisions = 1);

/// A box with sharp edges, for parts whose edges are never seen. UVs in metres.
Mesh plainBox(const glm::vec3& size);

/// A sphere of radius 1. u runs around from +z towards +x, v from the north pole (+y) down.
Mesh sphere(int columns, int rows);

/// Direction of a point of sphere() from its UV.
glm::vec3 sphereDirection(const glm::vec2& uv);

/// Turns a profile of (radius, height) around +y. The profile runs down the outer side; u goes around, v along the profile by length, both
/// [0,1].
Mesh turned(std::span<const glm::vec2> profile, int columns, float creaseDegrees = 40);

/// Point and radius along a swept tube.
struct Station {
    glm::vec3 position;
    float radius;
};

/// Sweeps a circle along stations and closes both ends. u around, v along, in metres.
Mesh tube(std::span<const Station> stations, int sides, float creaseDegrees = 50);

/// A straight tube.
Mesh bar(const glm::vec3& from, const glm::vec3& to, float radius, int sides = 6);

/// A smooth curve through control points (uniform Catmull-Rom), `steps` points per span.
std::vector<glm::vec2> smoothCurve(std::span<const glm::vec2> points, int steps);

/// A cushion of the given size: a superellipsoid whose middle bulges and whose rim stays thin.
Mesh cushion(const glm::vec3& size, int segments);

}  // namespace lodestir::generate
