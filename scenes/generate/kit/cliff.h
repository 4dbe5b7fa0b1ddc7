// SPDX-License-Identifier: MIT
// A coast of layered rock: a meadow that ends in cliffs, coves between headlands. The land lies at +x, the coast runs along z; metres, the sea at y = 0.
#pragma once

#include <cstdint>
#include <string>

#include <glm/glm.hpp>

#include "glb.h"
#include "noise.h"

namespace lodestir::generate {

class Cliff {
public:
    explicit Cliff(uint32_t seed) : noise{seed} {}

    static constexpr float nearEnd = 40, farEnd = -330;  ///< of z

    /// x of the cliffs' upper edge, before weather had its way.
    float edge(float z) const;
    /// Height of the meadow.
    float meadow(const glm::vec2& xz) const;

    /// All of it, as one mesh and one picture.
    Model model(Glb& glb, const std::string& name) const;

private:
    glm::vec3 at(float u, float v) const;
    float weathering(const glm::vec3& p) const;
    Surface surface(const glm::vec3& p, const glm::vec3& n) const;
    float layer(const glm::vec3& p) const;

    Noise noise;
};

}  // namespace lodestir::generate
