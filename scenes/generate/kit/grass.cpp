// SPDX-License-Identifier: MIT
// Heath plants: see grass.h.
#include "grass.h"

#include <cmath>
#include <vector>

#include "random.h"

namespace lodestir::generate {

Mesh grassTuft(uint32_t seed, const Tuft& tuft) {
    Random random(seed);
    Mesh mesh;
    constexpr int segments = 4;
    for (int i = 0; i < tuft.blades; ++i) {
        const float heading = random.between(0, 6.2831853f), spread = std::sqrt(random.next()) * tuft.radius;
        const glm::vec3 outward(std::cos(heading), 0, std::sin(heading));
        const float where = random.between(0, 6.2831853f);  // in a wide tuft blades bend every way, not only outward
        const float length = tuft.height * random.between(0.55f, 1.15f), width = random.between(0.0022f, 0.0048f);
        const float lean = random.between(0.1f, 0.55f) + 0.22f * spread / tuft.radius, droop = random.between(0.3f, 1.5f);
        const glm::vec3 side = glm::normalize(glm::vec3(-outward.z, random.between(-0.3f, 0.3f), outward.x));
        const glm::vec3 root = glm::vec3(std::cos(where), 0, std::sin(where)) * spread + glm::vec3(0, -0.01f, 0);

        const bool dry = random.next() < tuft.dryness;
        const glm::vec3 tip = dry ? glm::vec3(0.52f, 0.40f, 0.17f) : glm::vec3(0.24f, 0.30f, 0.07f);
        const glm::vec3 base = dry ? glm::vec3(0.22f, 0.17f, 0.07f) : glm::vec3(0.07f, 0.095f, 0.02f);
        const float tone = random.between(0.75f, 1.2f);

        const auto first = uint32_t(mesh.vertices.size());
        for (int k = 0; k <= segments; ++k) {
            const float t = float(k) / float(segments);
            // Leaning out at the root and drooping with the square of the height.
            const glm::vec3 p = root + outward * length * (lean * t + 0.35f * droop * t * t * t) +
                                glm::vec3(0, length * (t - 0.22f * droop * t * t * t), 0);
            const float half = width * (1 - 0.75f * t * t) * 0.5f;
            const glm::vec3 face = glm::normalize(glm::cross(side, outward * (lean + droop * t * t) + glm::vec3(0, 1, 0)));
            Vertex v{.position = p - side * half, .normal = face, .uv = {0, 1 - t}, .color = tone * glm::mix(base, tip, t)};
            if (k < segments) {
                mesh.add(v);
                v.position = p + side * half;
                v.uv.x = 1;
            } else {
                v.position = p;
                v.uv.x = 0.5f;
            }
            mesh.add(v);
        }
        for (uint32_t k = 0; k + 1 < uint32_t(segments); ++k)
            mesh.quad(first + 2 * k, first + 2 * k + 1, first + 2 * k + 3, first + 2 * k + 2);
        const uint32_t last = first + 2 * (segments - 1);
        mesh.triangle(last, last + 1, last + 2);
    }
    mesh.hasColors = true;
    return mesh;
}

Mesh shrub(uint32_t seed, int leaves) {
    Random random(seed);
    struct Dome {
        glm::vec3 centre;
        float radius;
    };
    std::vector<Dome> domes;
    for (int i = 0; i < 7; ++i)
        domes.push_back(
            {{random.between(-0.38f, 0.38f), random.between(0.16f, 0.42f), random.between(-0.38f, 0.38f)}, random.between(0.17f, 0.30f)});

    Mesh mesh;
    for (int i = 0; i < leaves; ++i) {
        const Dome& dome = domes[size_t(random.below(int(domes.size())))];
        const glm::vec3 out = glm::normalize(glm::vec3(random.bell(), random.bell() + 0.3f, random.bell()));
        const float depth = random.between(0.72f, 1.08f);
        const glm::vec3 root = dome.centre + out * dome.radius * depth;
        const glm::vec3 along = glm::normalize(out + 0.8f * glm::vec3(random.bell(), random.bell() + 0.5f, random.bell()));
        const glm::vec3 side = glm::normalize(glm::cross(along, glm::vec3(random.bell(), random.bell(), random.bell()) + 0.01f));
        const float length = random.between(0.035f, 0.075f), width = length * 0.34f;
        // Leaves deep in the bush are old and dark, the outer ones young.
        const float young = glm::smoothstep(0.72f, 1.08f, depth) * random.between(0.5f, 1.0f);
        const glm::vec3 color = glm::mix(glm::vec3(0.035f, 0.045f, 0.014f), glm::vec3(0.13f, 0.16f, 0.045f), young);
        // Normals lean outward, so that the bush is lit as one body and not as confetti.
        const glm::vec3 face = glm::normalize(glm::cross(side, along));
        const glm::vec3 normal = glm::normalize(out * 0.8f + (glm::dot(face, out) < 0 ? -face : face));
        const uint32_t a = mesh.add({.position = root - side * width, .normal = normal, .uv = {0, 1}, .color = color});
        const uint32_t b = mesh.add({.position = root + side * width, .normal = normal, .uv = {1, 1}, .color = color});
        const uint32_t c = mesh.add({.position = root + along * length, .normal = normal, .uv = {0.5f, 0}, .color = color * 1.25f});
        if (glm::dot(face, out) < 0)
            mesh.triangle(b, a, c);
        else
            mesh.triangle(a, b, c);
    }
    mesh.hasColors = true;
    return mesh;
}

}  // namespace lodestir::generate
