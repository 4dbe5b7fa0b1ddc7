// SPDX-License-Identifier: MIT
// See teapot.h.
#include "teapot.h"

#include <cmath>
#include <span>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "masonry.h"
#include "shapes.h"

namespace lodestir::generate {

namespace {

/// A tube through control points (x, y, radius).
Mesh sweep(std::span<const glm::vec3> control) {
    std::vector<glm::vec2> path, width;
    for (size_t i = 0; i < control.size(); ++i) {
        path.emplace_back(control[i]);
        width.emplace_back(float(i), control[i].z);
    }
    path = smoothCurve(path, 8);
    width = smoothCurve(width, 8);
    std::vector<Station> stations;
    for (size_t i = 0; i < path.size(); ++i) stations.push_back({glm::vec3(path[i], 0), width[i].y});
    return tube(stations, 28);
}

}  // namespace

Model teapot(const std::string& name, int material, float height) {
    // Of unit height, from the knob over lid and rim down the belly to the foot.
    const glm::vec2 profile[] = {{0, 1},        {0.055f, 0.985f}, {0.075f, 0.94f}, {0.03f, 0.88f},  {0.12f, 0.85f}, {0.30f, 0.79f}, {0.34f, 0.76f},
                                 {0.37f, 0.765f}, {0.40f, 0.74f},  {0.50f, 0.58f}, {0.56f, 0.38f}, {0.50f, 0.18f}, {0.36f, 0.06f}, {0.37f, 0.01f},
                                 {0.34f, 0.0f}, {0, 0.0f}};
    const glm::vec3 spout[] = {{0.40f, 0.28f, 0.13f}, {0.60f, 0.32f, 0.11f}, {0.73f, 0.48f, 0.075f}, {0.80f, 0.65f, 0.055f}, {0.93f, 0.76f, 0.055f}};
    const glm::vec3 handle[] = {{-0.38f, 0.66f, 0.042f}, {-0.62f, 0.70f, 0.045f}, {-0.82f, 0.60f, 0.045f}, {-0.78f, 0.38f, 0.045f}, {-0.50f, 0.22f, 0.040f}};
    std::vector<glm::vec2> body = smoothCurve(profile, 5);
    for (glm::vec2& p : body) p = glm::max(p, glm::vec2(0));  // the curve overshoots where it turns into the foot
    Mesh mesh = turned(body, 72, 60);
    append(mesh, sweep(spout));
    append(mesh, sweep(handle));
    scaleUv(mesh, glm::vec2(1 / earthenwareSize));
    Model model{name, {}};
    model.add(material, placed(mesh, glm::scale(glm::mat4(1), glm::vec3(height))));
    return model;
}

}  // namespace lodestir::generate
