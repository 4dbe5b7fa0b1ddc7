// SPDX-License-Identifier: MIT
// Still lifes to judge bias by, and their pieces: a closed chamber, glowing panels, turned vessels, cut gems. Each stresses one mechanism of
// path reuse, has few triangles, is cheap to trace and converges fast, for all its lamps are broad. Metres.
#pragma once

#include <span>
#include <string>

#include <glm/glm.hpp>

#include "glb.h"

namespace lodestir::generate {

/// A closed room in metres: floor at y = 0, x from -halfWidth to halfWidth, z from back to front. It holds the camera.
struct Chamber {
    float halfWidth = 1.7f, height = 2.0f;
    float back = -1.2f, front = 2.8f;
};

/// Materials of a chamber's faces, as indices.
struct ChamberPaints {
    int floor, ceiling, back, front, left, right;
};

/// The six faces, seen from inside.
Model chamber(const Chamber& shape, const ChamberPaints& paints);

/// A diffuse paint without any gloss: an index of refraction of 1 leaves the bare Lambertian lobe.
Material matt(const std::string& name, const glm::vec3& color);

/// A glowing sheet that reflects nothing.
Material glow(const std::string& name, const glm::vec3& radiance);

/// A model file under way: adds materials and things in one line each.
struct Composition {
    Glb glb;

    int paint(const std::string& name, const glm::vec3& color);
    int lamp(const std::string& name, const glm::vec3& radiance);
    int gloss(const std::string& name, const glm::vec3& color, float roughness, float metalness = 0);
    int put(const std::string& name, int material, const Mesh& mesh, const Placement& placement = {});

    /// A box and a ball that stand on the point `ground`.
    void block(const std::string& name, int material, const glm::vec3& size, const glm::vec3& ground, float turnDegrees = 0);
    void ball(const std::string& name, int material, float radius, const glm::vec3& ground, int columns = 24);
};

/// A flat sheet around `centre` that faces along `facing`; size.y runs upward, along z where it faces up or down.
Mesh panel(const glm::vec3& centre, const glm::vec3& facing, const glm::vec2& size);

/// A panel in a flat tray of 4 cm, so that it casts light forward only.
Model areaLamp(const std::string& name, int glowing, int tray, const glm::vec3& centre, const glm::vec3& facing, const glm::vec2& size);

/// Every triangle flat, none collapsed.
Mesh faceted(Mesh mesh);

/// A flat-faced crystal of radius 1 with `sides` sides: two crowns around a girdle.
Mesh gem(int sides);

/// A smooth profile of (radius, height) through control points, `steps` a span, turned around +y; none of it below y = 0.
Mesh lathe(std::span<const glm::vec2> control, int steps, int columns);

/// Upright vessels with an inner side, 1 high, standing on the origin.
Mesh jug(int columns);
Mesh dish(int columns);

/// A trefoil knot of tube, about 1 in radius, lying around the y axis.
Mesh knot(int stations, int sides, float thickness);

}  // namespace lodestir::generate
