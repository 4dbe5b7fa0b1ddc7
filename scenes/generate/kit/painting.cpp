// SPDX-License-Identifier: MIT
// Pictures to hang on a wall: see painting.h.
#include "painting.h"

#include <cmath>
#include <vector>

#include "noise.h"
#include "random.h"

namespace lodestir::generate {

namespace {

constexpr glm::vec3 paper(0.72f, 0.67f, 0.57f);

float grainAt(const Noise& noise, const glm::vec2& p) { return noise.fractal(glm::vec3(p * 900.0f, 0.5f), 2, 0.7f); }

}  // namespace

Textures paintPrint(uint32_t seed, int width, int height) {
    const Noise noise{seed};
    Random random(seed);
    const float aspect = float(height) / float(width);
    struct Shape {
        glm::vec2 centre;
        float radius, hole, cut;  ///< hole: inner radius as a share; cut: heading of the half plane that is left, below 0 for a full disc
        glm::vec3 ink;
    };
    const glm::vec3 inks[] = {
        {0.48f, 0.14f, 0.05f}, {0.60f, 0.36f, 0.08f}, {0.05f, 0.10f, 0.13f}, {0.14f, 0.20f, 0.16f}, {0.62f, 0.44f, 0.33f}};
    std::vector<Shape> shapes;
    for (int i = 0; i < 8; ++i)
        shapes.push_back({{random.between(0.22f, 0.78f), random.between(0.18f, 0.82f) * aspect},
                          random.between(0.09f, 0.27f),
                          random.next() < 0.35f ? random.between(0.45f, 0.8f) : 0.0f,
                          random.next() < 0.55f ? std::floor(random.between(0, 4)) * 1.57079633f : -1.0f,
                          inks[(i + random.below(2)) % 5]});
    return paint({.width = width, .height = height, .metres = {1, aspect}, .repeats = false, .smooth = true}, [&](const glm::vec2& p) {
        Surface s;
        s.color = paper;
        for (const Shape& shape : shapes) {
            const glm::vec2 d = p - shape.centre;
            const float r = glm::length(d);
            const bool half = shape.cut < 0 || glm::dot(d, glm::vec2(std::cos(shape.cut), std::sin(shape.cut))) > 0;
            if (r < shape.radius && r > shape.radius * shape.hole && half)
                s.color *= glm::mix(glm::vec3(1), shape.ink * 1.25f, 0.93f);  // inks overprint
        }
        s.color *= 1 + 0.06f * grainAt(noise, p * 0.3f);
        s.roughness = 0.85f;
        return s;
    });
}

Textures paintHills(uint32_t seed, int width, int height) {
    const Noise noise{seed};
    const float aspect = float(height) / float(width);
    return paint({.width = width, .height = height, .metres = {1, aspect}, .repeats = false, .smooth = true}, [&](const glm::vec2& p) {
        const float y = 1 - p.y / aspect;
        Surface s;
        s.color = glm::mix(glm::vec3(0.70f, 0.60f, 0.47f), glm::vec3(0.62f, 0.66f, 0.66f), glm::smoothstep(0.45f, 1.0f, y));
        const float sun = glm::length(glm::vec2(p.x - 0.68f, (y - 0.74f) * aspect));
        s.color = glm::mix(s.color, glm::vec3(0.78f, 0.36f, 0.16f), 0.85f * glm::smoothstep(0.072f, 0.066f, sun));
        constexpr int ranges = 6;
        for (int i = 0; i < ranges; ++i) {
            const float near = float(i) / (ranges - 1);
            const float crest = glm::mix(0.60f, 0.10f, near) +
                                glm::mix(0.11f, 0.07f, near) *
                                    noise.fractal({p.x * glm::mix(2.2f, 3.4f, near) + float(i) * 7, float(i) * 3.3f, 0.5f}, 6, 0.52f);
            if (y > crest) continue;
            // Mist gathers at the foot of each range.
            const glm::vec3 wash = glm::mix(glm::vec3(0.42f, 0.48f, 0.50f), glm::vec3(0.03f, 0.055f, 0.06f), std::pow(near, 0.8f));
            s.color = glm::mix(wash, glm::vec3(0.62f, 0.60f, 0.54f), 0.75f * glm::smoothstep(0.0f, 0.22f, crest - y) * (1 - near * 0.6f));
        }
        s.color *= 1 + 0.08f * grainAt(noise, p * 0.35f);
        s.roughness = 0.8f;
        return s;
    });
}

}  // namespace lodestir::generate
