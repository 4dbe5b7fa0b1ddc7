// SPDX-License-Identifier: MIT
// The camera where a scene names none.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

/// A three-quarter view (from the front, right and above) in which all corners of the bounds are inside the frame at 16:9 or wider.
LODESTIR_API CameraKey frameBounds(const std::array<glm::vec3, 2>& bounds);

}  // namespace lodestir
