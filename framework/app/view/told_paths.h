// SPDX-License-Identifier: MIT
// The paths in what shaders told of a pixel, as lines in the scene. Plain values; no window, no GPU.
#pragma once
#include <framework/core/api.h>

#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace lodestir {

struct ToldPath {
    std::string pass;
    std::string name;  ///< what it is: "tree", "shift forth (86, 52) -> (101, 52)"
    std::string text;  ///< what came of it: "J 1.904, taken", "something is in the way"
    bool failed = false;
    std::vector<glm::vec3> vertices;  ///< from x_1 on, scene units
};

/// Of `passes` as pixelReport() has them, in order: all that has "vertices" with a "position".
LODESTIR_API std::vector<ToldPath> pathsIn(const nlohmann::ordered_json& passes);

}  // namespace lodestir
