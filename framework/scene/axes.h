// SPDX-License-Identifier: MIT
// Directions out of matrices and views that may be degenerate.
#pragma once
#include <framework/core/api.h>
#include <framework/scene/scene.h>

namespace lodestir {

/// Unit vectors along the axes of a node, whose matrix may stretch, shear and mirror. An axis without length is put at right angles to the others.
LODESTIR_API glm::mat3 unitAxes(const glm::mat4& matrix);

/// Unit vectors of the picture at right angles to each other.
struct ViewAxes {
    glm::vec3 right, up, forward;
};
/// A camera at its target looks along -Z; one that looks along its `up` is turned in some way.
LODESTIR_API ViewAxes viewAxes(const CameraKey& camera);

}  // namespace lodestir
