// SPDX-License-Identifier: MIT
// What hulls and hangars are clad with, and a planet to fly over.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "picture.h"

namespace lodestir::generate {

/// Dark floor plates with seams and bolts, polished by traffic. Repeats after 3 m.
Textures paintPlates(uint32_t seed, int width);
constexpr float platesSize = 3.0f;

/// Oceans, deserts, green coasts and clouds in the light of a sun in a direction, for a surface that is shown as it is; laid out as sphere() lays its UVs.
Textures paintPlanet(uint32_t seed, int width, const glm::vec3& sun);

}  // namespace lodestir::generate
