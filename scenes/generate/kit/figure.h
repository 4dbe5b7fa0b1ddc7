// SPDX-License-Identifier: MIT
// What makes a body of clay a figure: a picture of its own, painted point by point.
#pragma once

#include <functional>
#include <string>

#include "glb.h"

namespace lodestir::generate {

/// A mesh of charted() in one material, whose pictures are `texels` a side. `surface` says what a place is.
Model figure(Glb& glb, const std::string& name, const Mesh& charted, int texels,
             const std::function<Surface(const glm::vec3& position, const glm::vec3& normal)>& surface);

/// Puts something smooth over a surface, which hides that share of it: an eye, a hoof, gilding.
void cover(Surface& s, const glm::vec3& color, float roughness, float share, float metalness = 0);

}  // namespace lodestir::generate
