// SPDX-License-Identifier: MIT
// What of a scene is seen at a place of the picture. On the CPU, so that it asks nothing of the graph; no window.
#pragma once
#include <framework/app/view/orbit_camera.h>
#include <framework/scene/deformation.h>

#include <optional>
#include <span>

namespace lodestir {

struct Picked {
    std::uint32_t instance = none, material = none;
    glm::vec3 point{0};  ///< world space
};

/// The nearest triangle of the levels shown (one of each instance) that a ray meets; textures that cut holes aren't looked at. Instances whose boxes
/// the ray meets farther away than a hit are left out, those that it meets are gone through triangle by triangle.
LODESTIR_API std::optional<Picked> pick(const Scene& scene, const Pose& pose, std::span<const std::uint32_t> levels, const ViewRay& ray);

}  // namespace lodestir
