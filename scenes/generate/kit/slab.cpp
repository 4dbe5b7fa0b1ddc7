// SPDX-License-Identifier: MIT
// See slab.h.
#include "slab.h"

#include "shapes.h"

namespace lodestir::generate {

Mesh slab(const glm::vec3& low, const glm::vec3& high, float repeat, float bevel) {
    Mesh mesh = bevel > 0 ? roundedBox(high - low, bevel, 3) : plainBox(high - low);
    scaleUv(mesh, glm::vec2(1 / repeat));
    return placed(mesh, 0.5f * (low + high));
}

}  // namespace lodestir::generate
