// SPDX-License-Identifier: MIT
// What shaders told of a pixel, put in order.
#pragma once
#include <framework/graph/probe.h>

#include <nlohmann/json_fwd.hpp>

namespace lodestir {

/// An object for each invocation that told something, that of `pixel` first: {"pixel": [x, y], ...}. Scopes are members of lists, or objects; what was told
/// twice in one scope is a list. Numbers that are not finite are "nan", "inf", "-inf".
LODESTIR_API nlohmann::ordered_json probeTree(const ProbedDispatch& dispatch, glm::ivec2 pixel);
/// The shortest number that gives the float back; a text where it is not finite.
LODESTIR_API nlohmann::ordered_json numberJson(float value);

}  // namespace lodestir
