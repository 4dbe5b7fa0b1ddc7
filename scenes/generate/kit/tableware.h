// SPDX-License-Identifier: MIT
// Turned vessels and what lies in them: bowls, vases, pots, mugs, fruit. All stand on y = 0.
#pragma once

#include <cstdint>
#include <string>

#include "glb.h"

namespace lodestir::generate {

Model bowl(const std::string& name, int material, float radius);
Model vase(const std::string& name, int material, float height, float radius);
Model mug(const std::string& name, int material);

/// A flower pot filled with soil.
Model pot(const std::string& name, int material, int soil, float height);

/// Oranges and lemons heaped for a bowl of the given radius; colours in the vertices.
Model fruit(const std::string& name, int material, uint32_t seed, float bowlRadius);

}  // namespace lodestir::generate
