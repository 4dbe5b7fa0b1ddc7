// SPDX-License-Identifier: MIT
// Smooth curves in space: see spline.h.
#include "spline.h"

#include <algorithm>

namespace lodestir::generate {

std::vector<Station> spline(std::span<const Station> stations, int steps) {
    const int last = int(stations.size()) - 1;
    const auto at = [&](int i) {
        const Station& s = stations[size_t(std::clamp(i, 0, last))];
        return glm::vec4(s.position, s.radius);
    };
    std::vector<Station> curve;
    for (int i = 0; i < last; ++i)
        for (int k = 0; k < steps; ++k) {
            const float t = float(k) / float(steps);
            const glm::vec4 a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
            const glm::vec4 p = 0.5f * (2.0f * b + (c - a) * t + (2.0f * a - 5.0f * b + 4.0f * c - d) * t * t + (3.0f * b - a - 3.0f * c + d) * t * t * t);
            curve.push_back({glm::vec3(p), std::max(p.w, 1e-3f)});
        }
    curve.push_back(stations.back());
    return curve;
}

Mesh limb(std::span<const Station> stations, int steps, int sides) { return tube(spline(stations, steps), sides); }

Mesh moulding(std::span<const glm::vec3> path, std::span<const glm::vec2> profile, float creaseDegrees) {
    Mesh mesh;
    float along = 0;
    for (size_t i = 0; i < path.size(); ++i) {
        const glm::vec3 from = path[i > 0 ? i - 1 : 0], to = path[std::min(i + 1, path.size() - 1)];
        const glm::vec3 ahead = glm::normalize(to - from);
        const glm::vec3 right = glm::normalize(glm::cross(ahead, glm::vec3(0, 1, 0))), up = glm::cross(right, ahead);
        if (i > 0) along += glm::distance(path[i - 1], path[i]);
        // At a bend the section is that of the mitre: wider by what the step leans away from the walker's heading.
        const glm::vec3 step = glm::normalize(i + 1 < path.size() ? path[i + 1] - path[i] : path[i] - path[i - 1]);
        const float mitre = 1 / std::max(glm::dot(step, ahead), 0.3f);
        float around = 0;
        for (size_t k = 0; k < profile.size(); ++k) {
            if (k > 0) around += glm::distance(profile[k - 1], profile[k]);
            mesh.add({.position = path[i] + right * (profile[k].x * mitre) + up * profile[k].y, .uv = {along, around}});
        }
    }
    const auto stride = uint32_t(profile.size());
    for (uint32_t i = 0; i + 1 < uint32_t(path.size()); ++i)
        for (uint32_t k = 0; k + 1 < stride; ++k) {
            const uint32_t a = i * stride + k;
            mesh.quad(a, a + 1, a + stride + 1, a + stride);
        }
    computeNormals(mesh, creaseDegrees);
    return mesh;
}

std::vector<glm::vec3> cord(const glm::vec3& from, const glm::vec3& to, float sag, int count) {
    std::vector<glm::vec3> points;
    for (int i = 0; i <= count; ++i) {
        const float t = float(i) / float(count);
        points.push_back(glm::mix(from, to, t) - glm::vec3(0, 4 * sag * t * (1 - t), 0));  // a parabola is close to the catenary of a taut cord
    }
    return points;
}

}  // namespace lodestir::generate
