// SPDX-License-Identifier: MIT
// Pictures of landscapes: see landscape.h.
#include "landscape.h"

#include <cmath>

namespace lodestir::generate {

Lattice::Lattice(const Mesh& grid, int c, int r) : columns(c), rows(r), points(size_t(c + 1) * size_t(r + 1)) {
    for (const Vertex& v : grid.vertices) {
        const auto x = size_t(std::lround(v.uv.x * float(columns))), y = size_t(std::lround(v.uv.y * float(rows)));
        points[y * size_t(columns + 1) + x] = {v.position, v.normal};
    }
}

Lattice::Point Lattice::at(const glm::vec2& uv) const {
    const glm::vec2 p = glm::clamp(uv, 0.0f, 1.0f) * glm::vec2(columns, rows);
    const glm::ivec2 cell = glm::min(glm::ivec2(p), glm::ivec2(columns - 1, rows - 1));
    const glm::vec2 f = p - glm::vec2(cell);
    const Point* corner = &points[size_t(cell.y) * size_t(columns + 1) + size_t(cell.x)];
    const auto mean = [&](auto member) {
        return glm::mix(glm::mix(corner[0].*member, corner[1].*member, f.x), glm::mix(corner[columns + 1].*member, corner[columns + 2].*member, f.x), f.y);
    };
    return {mean(&Point::position), glm::normalize(mean(&Point::normal))};
}

Textures paintLattice(const Lattice& lattice, const glm::ivec2& texels, const glm::vec2& metres,
                      const std::function<Surface(const Lattice::Point& point)>& surface) {
    return paint({.width = texels.x, .height = texels.y, .metres = metres, .repeats = false},
                 [&](const glm::vec2& p) { return surface(lattice.at(p / metres)); });
}

}  // namespace lodestir::generate
