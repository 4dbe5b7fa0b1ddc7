// SPDX-License-Identifier: MIT
// Pictures of what lies open: of a grid of ground or rock, painted by what its places are.
#pragma once

#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "mesh.h"
#include "picture.h"

namespace lodestir::generate {

/// Points of a mesh of grid(columns, rows) between its vertices.
class Lattice {
public:
    Lattice(const Mesh& grid, int columns, int rows);

    struct Point {
        glm::vec3 position, normal;
    };
    Point at(const glm::vec2& uv) const;

private:
    int columns, rows;
    std::vector<Point> points;
};

/// One picture that covers the whole grid, `metres` large on it in the mean. `surface` says what a place is.
Textures paintLattice(const Lattice& lattice, const glm::ivec2& texels, const glm::vec2& metres,
                      const std::function<Surface(const Lattice::Point& point)>& surface);

}  // namespace lodestir::generate
