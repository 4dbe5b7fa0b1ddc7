// SPDX-License-Identifier: MIT
// Broken rock: a faceted block displaced by domain-warped ridges, cracks and strata; its mesh is a cube-sphere in six charts, its pictures
// are baked from the same noise.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "mesh.h"
#include "noise.h"
#include "picture.h"

namespace lodestir::generate {

/// Proportions of a stone.
struct StoneForm {
    glm::vec3 size{1};     ///< half extents, metres
    int facets = 18;       ///< fracture planes of the block
    float sharpness = 16;  ///< of the edges between them; 4 is a cobble
    float relief = 1;      ///< strength of ridges, cracks and strata
};

/// A point of the stone and what the noise had to say about it.
struct StonePoint {
    glm::vec3 position;
    float crack = 0;  ///< 0 on the open face, 1 deep in a crack
    float layer = 0;  ///< coordinate across the strata, one per bed
    float fine = 0;   ///< fine relief, about [-1, 1]
};

class Stone {
public:
    Stone(uint32_t seed, const StoneForm& form);

    /// The surface in a direction from the middle. Without `fine` the relief that a mesh can't carry is left out.
    StonePoint at(const glm::vec3& direction, bool fine) const;

    /// A closed cube-sphere of 12 * n * n triangles. Borders of charts share positions and normals bit for bit; only UVs differ.
    Mesh mesh(int n) const;

    /// Pictures for mesh(n): the normals hold what lies between the triangles of that mesh and the full relief.
    Textures bake(const Mesh& mesh, int chartTexels) const;

private:
    Surface weathered(const StonePoint& point, const glm::vec3& normal) const;

    StoneForm form;
    Noise noise;
    glm::vec3 bedding;                                ///< unit vector across the strata
    std::vector<std::pair<glm::vec3, float>> planes;  ///< fracture planes: normal and distance
};

}  // namespace lodestir::generate
