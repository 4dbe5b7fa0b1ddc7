// SPDX-License-Identifier: MIT
// Lattice girders: see truss.h.
#include "truss.h"

#include <vector>

#include "shapes.h"

namespace lodestir::generate {

Mesh lattice(std::span<const glm::vec3> upper, std::span<const glm::vec3> lower, float chordRadius, float braceRadius) {
    Mesh mesh;
    for (const std::span<const glm::vec3>& chord : {upper, lower}) {
        std::vector<Station> stations;
        for (const glm::vec3& p : chord) stations.push_back({p, chordRadius});
        append(mesh, tube(stations, 6));
    }
    for (size_t i = 0; i < upper.size(); ++i) {
        append(mesh, bar(lower[i], upper[i], braceRadius, 4));
        if (i + 1 == upper.size()) break;
        append(mesh, bar(lower[i], upper[i + 1], braceRadius, 4));
        append(mesh, bar(upper[i], lower[i + 1], braceRadius, 4));
    }
    return mesh;
}

Mesh girder(const glm::vec3& from, const glm::vec3& to, float height, int bays, float chordRadius, float braceRadius) {
    std::vector<glm::vec3> upper, lower;
    for (int i = 0; i <= bays; ++i) {
        lower.push_back(glm::mix(from, to, float(i) / float(bays)));
        upper.push_back(lower.back() + glm::vec3(0, height, 0));
    }
    return lattice(upper, lower, chordRadius, braceRadius);
}

}  // namespace lodestir::generate
