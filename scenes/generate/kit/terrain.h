// SPDX-License-Identifier: MIT
// Open ground: a heightfield that is fine near the middle and coarse towards the hills, with a picture of soil and straw.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "mesh.h"
#include "noise.h"
#include "picture.h"

namespace lodestir::generate {

class Terrain {
public:
    explicit Terrain(uint32_t seed) : noise{seed} {}

    /// Height above the origin's level, metres.
    float height(const glm::vec2& xz) const;
    glm::vec3 normal(const glm::vec2& xz) const;

    /// How much grass a place bears, [0, 1].
    float meadow(const glm::vec2& xz) const;

    /// (n + 1)^2 vertices over 800 m x 800 m, a decimetre apart in the middle; vertex colours tint the picture.
    Mesh mesh(int n) const;

private:
    Noise noise;
};

/// Soil, grit and straw; repeats after groundSize metres.
Textures paintGround(uint32_t seed, int width);
constexpr float groundSize = 3.0f;

}  // namespace lodestir::generate
