// SPDX-License-Identifier: MIT
// Wooden parts: see joinery.h.
#include "joinery.h"

#include <vector>

#include "random.h"
#include "wood.h"

namespace lodestir::generate {

namespace {

glm::vec2 cut(uint32_t seed) { return {unit(hash(seed, 1)), unit(hash(seed, 2))}; }

}  // namespace

Mesh plank(const glm::vec3& size, Axis grain, uint32_t seed, float radius, int divisions) {
    Mesh mesh = roundedBox(size, radius, 2, grain, divisions);
    scaleUv(mesh, 1.0f / panelSize, cut(seed));
    return mesh;
}

Mesh rod(const glm::vec3& from, const glm::vec3& to, float radiusFrom, float radiusTo, uint32_t seed) {
    const glm::vec3 along = glm::normalize(to - from);
    std::vector<Station> stations;
    const auto rim = [&](const glm::vec3& p, float radius, float inward) {
        const float soft = radius * 0.25f;
        stations.push_back({p, radius - soft});
        stations.push_back({p + along * (inward * soft * 0.3f), radius - soft * 0.3f});
        stations.push_back({p + along * (inward * soft), radius});
    };
    rim(from, radiusFrom, 1);
    stations.push_back({(from + to) * 0.5f, (radiusFrom + radiusTo) * 0.5f});
    std::vector<Station> head = std::move(stations);
    stations.clear();
    rim(to, radiusTo, -1);
    head.insert(head.end(), stations.rbegin(), stations.rend());

    Mesh mesh = tube(head, 16);
    for (Vertex& v : mesh.vertices) v.uv = glm::vec2(v.uv.y, v.uv.x) / panelSize + cut(seed);  // grain along the bar
    return mesh;
}

}  // namespace lodestir::generate
