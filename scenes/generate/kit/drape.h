// SPDX-License-Identifier: MIT
// Cloth that fell onto things and came to rest: particles held together by their distances.
#pragma once

#include <functional>

#include <glm/glm.hpp>

#include "isosurface.h"
#include "mesh.h"
#include "picture.h"

namespace lodestir::generate {

/// How a cloth falls.
struct Drape {
    glm::vec2 size;       ///< metres
    glm::vec3 centre;     ///< of the cloth before it falls, level
    float turn = 0;       ///< about the vertical, radians
    Distance obstacle;    ///< what it falls onto
    int particles = 100;  ///< a side
    int steps = 260;      ///< of a sixtieth of a second
};

/// The cloth at rest, in `cells` x `cells` squares. UVs span it. `relief`: metres that a place stands out from the upper side.
Mesh draped(const Drape& drape, int cells, const std::function<float(const glm::vec2& uv)>& relief);

/// Damask: the pattern that its weave raises out of the ground, [0, 1], for a place in metres. Repeats after damaskSize.
float damask(const glm::vec2& metres);
constexpr glm::vec2 damaskSize{0.26f, 0.39f};

/// Such a cloth of `metres`, one picture over all of it: figures of satin on a ribbed ground. The pattern is not in its normals, which leave it to the mesh.
Textures paintDamask(const glm::vec2& metres, const glm::vec3& ground, const glm::vec3& figure, uint32_t seed, int width);

}  // namespace lodestir::generate
