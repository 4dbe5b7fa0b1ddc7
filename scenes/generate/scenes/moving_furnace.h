// SPDX-License-Identifier: MIT
// What the answer of the moving furnace hangs on: its two panels and the lights without extent that shine on them. Metres.
#pragma once

#include <glm/glm.hpp>

namespace lodestir::generate::furnace {

/// A rectangle through its upper-left corner, seen from the front.
struct Panel {
    glm::vec3 corner, right, down;
};
constexpr Panel floorPanel{{0.3f, 0, -1}, {2.4f, 0, 0}, {0, 0, 2}}, wallPanel{{0.3f, 2, -1.4f}, {2.4f, 0, 0}, {0, -1.5f, 0}};
constexpr float albedo = 0.6f;  ///< of both

struct Lamp {
    glm::vec3 position;
    float intensity;  ///< cd
};
constexpr float sun = 1.5f;  ///< lx, straight down
constexpr Lamp bulb{{1, 1.2f, 0.2f}, 4}, spot{{2.2f, 1.6f, 0.6f}, 8};
constexpr glm::vec3 spotTarget{1.8f, 0.9f, -1.4f};
constexpr float spotInner = 30, spotOuter = 60;  ///< half angles, degrees

}  // namespace lodestir::generate::furnace
