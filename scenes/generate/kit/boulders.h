// SPDX-License-Identifier: MIT
// A field of boulders that share one model: what its triangles cost is asked 4,096 times.
#pragma once

#include "glb.h"

namespace lodestir::generate {

constexpr int boulderCount = 4096;
constexpr int boulderCells = 20;  ///< along a chart of the plainest model: 12 * 20^2 = 4,800 triangles

/// The field with a model of 4,800 `growth`^2 triangles. All else is the same whatever the growth: places, sizes, ground.
Glb boulderField(int growth);

}  // namespace lodestir::generate
