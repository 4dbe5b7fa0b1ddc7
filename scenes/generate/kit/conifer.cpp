// SPDX-License-Identifier: MIT
// Spruces: see conifer.h.
#include "conifer.h"

#include <algorithm>
#include <cmath>

#include "random.h"
#include "shapes.h"

namespace lodestir::generate {

Mesh spruce(uint32_t seed) {
    Random random(seed);
    Mesh tree = bar({0, -0.05f, 0}, {0, 0.97f, 0}, 0.013f, 5);
    for (Vertex& v : tree.vertices) v.color = {0.09f, 0.06f, 0.045f};
    constexpr int whorls = 22;
    for (int w = 0; w < whorls; ++w) {
        const float t = (float(w) + random.next()) / whorls, height = 0.10f + 0.88f * t, reach = 0.21f * std::pow(1 - t, 0.8f) + 0.018f;
        const int boughs = 6 + int(5 * (1 - t));
        for (int b = 0; b < boughs; ++b) {
            const float a = 6.2831853f * (float(b) + 0.8f * random.next()) / float(boughs), length = reach * random.between(0.7f, 1.1f);
            const glm::vec3 out(std::cos(a), 0, std::sin(a)), across(-out.z, 0, out.x), root(0, height, 0);
            // Boughs droop, the lower ones more, and lift their tips; on each a row of sprays that hang to both sides.
            const auto along = [&](float s) { return root + length * (s * out + glm::vec3(0, (0.22f - 0.75f * (1 - t)) * s + 0.25f * s * s, 0)); };
            constexpr int sprays = 3;
            for (int k = 0; k < sprays; ++k) {
                const float from = float(k) / sprays, to = std::min(from + 0.55f, 1.0f), wide = length * 0.30f * (1.1f - from);
                const float fresh = 0.25f + 0.75f * to * random.between(0.6f, 1.0f);
                const glm::vec3 color = glm::mix(glm::vec3(0.010f, 0.026f, 0.014f), glm::vec3(0.045f, 0.085f, 0.030f), fresh);
                const glm::vec3 hang(0, -0.35f * wide, 0), normal = glm::normalize(0.6f * out + glm::vec3(0, 0.8f, 0));
                const auto add = [&](const glm::vec3& p, float shade) { return tree.add({.position = p, .normal = normal, .color = color * shade}); };
                const uint32_t start = add(along(from), 0.6f), end = add(along(to), 1.1f);
                for (float side : {-1.0f, 1.0f}) {
                    const uint32_t tip = add(along(0.6f * to + 0.4f * from) + side * wide * across + hang, 1.0f);
                    side > 0 ? tree.triangle(start, tip, end) : tree.triangle(start, end, tip);
                }
            }
        }
    }
    tree.hasColors = true;
    return tree;
}

}  // namespace lodestir::generate
