// SPDX-License-Identifier: MIT
// Animation of nodes in linear pieces.
#pragma once

#include <functional>

#include "glb.h"

namespace lodestir::generate {

/// Moves a node through at(t), t from 0 to 1, in that many pieces, 24 a second.
void animate(Glb& glb, int node, Motion motion, int pieces, const std::function<glm::vec4(float t)>& at);

inline constexpr int loopPieces = 40;  ///< of the still lifes' loops, whose ends meet

/// A rotation as Glb::animate takes it.
glm::vec4 asVector(const glm::quat& q);

}  // namespace lodestir::generate
