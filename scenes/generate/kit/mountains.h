// SPDX-License-Identifier: MIT
// High mountains: ridges that rain has cut into, painted by slope and height: snow, rock, scree, meadow, forest floor.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "glb.h"
#include "noise.h"

namespace lodestir::generate {

class Mountains {
public:
    explicit Mountains(uint32_t seed);

    static constexpr float size = 4000;  ///< metres a side, around the origin
    static constexpr float lake = 62;    ///< its level
    static constexpr float treeLine = 380, snowLine = 500;

    float height(const glm::vec2& xz) const;
    glm::vec3 normal(const glm::vec2& xz) const;
    /// Where trees grow, [0, 1].
    float forest(const glm::vec2& xz) const;

    /// The ground as one mesh of 2 `cells`^2 triangles and one picture of `texels` a side.
    Model model(Glb& glb, const std::string& name, int cells, int texels) const;

private:
    void erode(int drops);
    Surface surface(const glm::vec3& p, const glm::vec3& n) const;

    Noise noise;
    std::vector<float> heights;  ///< of a square of points, row by row from -z
};

}  // namespace lodestir::generate
