// SPDX-License-Identifier: MIT
// See grip.h.
#include "grip.h"

#include "shapes.h"

namespace lodestir::generate {

Mesh grip(const glm::vec3& from, const glm::vec3& to, const glm::vec3& out, float radius) {
    const glm::vec3 along = glm::normalize(to - from), over = 2.5f * radius * along;
    const auto station = [&](const glm::vec3& p, float share) { return Station{p + out, radius * share}; };
    const Station rail[] = {station(from - over, 0.6f), station(from - 0.9f * over, 0.9f), station(from - 0.75f * over, 1), station(0.5f * (from + to), 1),
                            station(to + 0.75f * over, 1), station(to + 0.9f * over, 0.9f), station(to + over, 0.6f)};
    Mesh mesh = tube(rail, 20);
    for (const glm::vec3& foot : {from, to}) append(mesh, bar(foot, foot + out, 0.8f * radius, 16));
    return mesh;
}

}  // namespace lodestir::generate
