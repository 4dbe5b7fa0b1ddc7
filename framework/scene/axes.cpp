// SPDX-License-Identifier: MIT
#include <framework/scene/axes.h>

#include <framework/scene/shading_frame.h>

#include <cmath>

namespace lodestir {
namespace {

/// Zero where the vector has no direction. In double precision: the square of a large or small float is none.
glm::vec3 unitOrZero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0);
}

glm::vec3 unitOr(const glm::dvec3& v, glm::vec3 otherwise) {
    const glm::vec3 unit = unitOrZero(v);
    return unit == glm::vec3(0) ? otherwise : unit;
}

}  // namespace

glm::mat3 unitAxes(const glm::mat4& matrix) {
    glm::mat3 axes;
    for (int i = 0; i < 3; ++i) axes[i] = unitOrZero(glm::dvec3(matrix[i]));
    for (int i = 0; i < 3; ++i) {
        if (axes[i] != glm::vec3(0)) continue;
        const glm::vec3 next = axes[(i + 1) % 3], last = axes[(i + 2) % 3];
        glm::vec3 own(0);
        own[i] = 1;
        // Of the two others one may be missing as well, or both.
        const glm::vec3 known = next != glm::vec3(0) ? next : last;
        axes[i] = unitOr(glm::cross(next, last), known != glm::vec3(0) ? perpendicular(known) : own);
    }
    return axes;
}

ViewAxes viewAxes(const CameraKey& camera) {
    const glm::vec3 forward = unitOr(glm::dvec3(camera.target) - glm::dvec3(camera.position), glm::vec3(0, 0, -1));
    const glm::dvec3 side = glm::cross(glm::dvec3(forward), glm::dvec3(unitOrZero(glm::dvec3(camera.up))));
    const glm::vec3 right = glm::length(side) > 1e-6 ? unitOrZero(side) : unitOr(glm::cross(forward, glm::vec3(0, 0, 1)), perpendicular(forward));
    return {right, glm::cross(right, forward), forward};
}

}  // namespace lodestir
