// SPDX-License-Identifier: MIT
// Paper lanterns: paper pleated over rings of bamboo, lit from within, between caps of black lacquer.
#pragma once

#include <cstdint>

#include "mesh.h"
#include "picture.h"

namespace lodestir::generate {

/// The paper, 2 tall and 2 wide around the origin. UVs: u around, v down, in the unit square.
Mesh lanternPaper();

/// What it shows: a crest in ink, bands at its ends, paper that is brightest where the flame is behind it. `tint` is the colour of that light.
Textures paintLanternPaper(const glm::vec3& tint, const glm::vec3& ink, uint32_t seed, int width);

/// What else a lantern of that paper has: rings of lacquer around its ends, the upper one with a lid, a cord up to where it hangs, `drop` above its middle,
/// a silk tassel, and the light that leaves by its mouth, as a disc.
struct LanternFittings {
    Mesh lacquer, silk, flame;
};
LanternFittings lanternFittings(float drop);

}  // namespace lodestir::generate
