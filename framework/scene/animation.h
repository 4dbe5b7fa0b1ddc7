// SPDX-License-Identifier: MIT
// Poses over time: glTF's interpolations of node transforms and of morph weights.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

/// The node's own matrix: its `matrix`, else translation * rotation * scale.
LODESTIR_API glm::mat4 localMatrix(const Node& node);

/// Value of a channel at a time in seconds, constant outside its keys: xyz0, or a unit quaternion xyzw for rotations.
/// step, linear (rotations: spherical, on the shorter way) and cubic as in glTF 2.0, appendix C.
LODESTIR_API glm::vec4 evaluate(const AnimationChannel& channel, float time);

}  // namespace lodestir
