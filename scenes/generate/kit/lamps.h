// SPDX-License-Identifier: MIT
// Small lamps by the hundred: bulbs, rows of them, street lamps. Every triangle of what glows is a light, so bulbs have few.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "glb.h"

namespace lodestir::generate {

/// A globe of 36 triangles.
Mesh bulb(const glm::vec3& centre, float radius);

/// A cord with bulbs hanging below it, a cap over each.
struct Festoon {
    glm::vec3 from, to;
    float sag = 0.4f;  ///< metres in the middle
    int bulbs = 12;
    float radius = 0.04f;  ///< of a bulb, metres
};
void addFestoon(Model& model, int cable, int glow, const Festoon& festoon);

/// A cast-iron street lamp that stands on the origin, with one globe on top or, with `arms`, three.
Model streetLamp(const std::string& name, int iron, int glow, float height, bool arms);

}  // namespace lodestir::generate
