// SPDX-License-Identifier: MIT
// Reflectance of metals at normal incidence, linear Rec.709.
#pragma once

#include <glm/glm.hpp>

namespace lodestir::generate {

inline constexpr glm::vec3 gold{1.0f, 0.77f, 0.34f}, copper{0.95f, 0.64f, 0.54f}, steel{0.56f, 0.57f, 0.58f}, silver{0.93f, 0.92f, 0.89f},
    chrome{0.65f, 0.68f, 0.70f};

}  // namespace lodestir::generate
