// SPDX-License-Identifier: MIT
// Small lamps: see lamps.h.
#include "lamps.h"

#include <vector>

#include "shapes.h"
#include "spline.h"

namespace lodestir::generate {

Mesh bulb(const glm::vec3& centre, float radius) {
    Mesh mesh = sphere(6, 4);
    for (Vertex& v : mesh.vertices) v.position = centre + radius * v.position;
    return mesh;
}

void addFestoon(Model& model, int cable, int glow, const Festoon& festoon) {
    const std::vector<glm::vec3> points = cord(festoon.from, festoon.to, festoon.sag, festoon.bulbs + 1);
    std::vector<Station> stations;
    for (const glm::vec3& p : points) stations.push_back({p, 0.008f});
    model.add(cable, tube(stations, 4));
    for (size_t i = 1; i + 1 < points.size(); ++i) {
        const glm::vec3 below = points[i] - glm::vec3(0, 1.9f * festoon.radius, 0);
        model.add(glow, bulb(below, festoon.radius));
        model.add(cable, bar(points[i], points[i] - glm::vec3(0, 1.15f * festoon.radius, 0), 0.45f * festoon.radius, 5));
    }
}

Model streetLamp(const std::string& name, int iron, int glow, float height, bool arms) {
    Model lamp{name, {}};
    const float h = height;
    const glm::vec2 control[] = {{0.035f, h},         {0.05f, h - 0.05f}, {0.032f, h - 0.12f}, {0.036f, h * 0.6f}, {0.05f, h * 0.36f},
                                 {0.075f, h * 0.34f}, {0.05f, h * 0.31f}, {0.062f, 0.7f},      {0.12f, 0.6f},      {0.105f, 0.3f},
                                 {0.17f, 0.2f},       {0.19f, 0.02f},     {0.19f, 0}};
    lamp.add(iron, turned(smoothCurve(control, 3), 12, 50));
    const float radius = 0.055f * h;
    const auto globe = [&](const glm::vec3& foot) {
        const glm::vec2 cup[] = {{0.5f * radius, 0.25f * radius}, {0.45f * radius, 0.1f * radius}, {0.2f * radius, -0.2f * radius}, {0, -0.3f * radius}};
        lamp.add(iron, placed(turned(cup, 10), foot));
        lamp.add(glow, bulb(foot + glm::vec3(0, radius, 0), radius));
        const glm::vec2 cap[] = {{0, 2.5f * radius}, {0.1f * radius, 2.2f * radius}, {0.5f * radius, 1.95f * radius}, {0.55f * radius, 1.85f * radius}};
        lamp.add(iron, placed(turned(cap, 10), foot));
    };
    globe({0, h + 0.02f, 0});
    if (arms)
        for (float side : {-1.0f, 1.0f}) {
            const float reach = 0.13f * h;
            const Station arm[] = {{{0, h * 0.80f, 0}, 0.03f},
                                   {{side * reach * 0.6f, h * 0.79f, 0}, 0.024f},
                                   {{side * reach, h * 0.83f, 0}, 0.02f},
                                   {{side * reach, h * 0.855f, 0}, 0.02f}};
            lamp.add(iron, limb(arm, 4, 8));
            globe({side * reach, h * 0.87f, 0});
        }
    return lamp;
}

}  // namespace lodestir::generate
