// SPDX-License-Identifier: MIT
// Plants: see foliage.h.
#include "foliage.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "noise.h"
#include "random.h"
#include "shapes.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 6.2831853f;

/// Half width of the leaf at a height t from stalk (0) to tip (1), in picture widths.
float outline(float t) {
    const float belly = std::pow(std::sin(std::pow(t, 0.82f) * tau / 2), 0.85f);
    return 0.45f * belly;
}

/// One leaf: rooted at the origin, growing along `along`, facing `face`; it droops towards the tip and folds up along its midrib.
Mesh leafMesh(const glm::vec3& root, const glm::vec3& along, const glm::vec3& face, float length, float droop, const glm::ivec2& cells = {4, 8}) {
    const glm::vec3 forward = glm::normalize(along), side = glm::normalize(glm::cross(forward, face)), up = glm::cross(side, forward);
    const float width = length * 0.5f;
    return grid(cells.x, cells.y, [&](float u, float v) {
        const float t = 1 - v, x = u - 0.5f;
        const float fold = 0.30f * std::abs(x) * width, sag = droop * length * t * t;
        return root + forward * (length * t * (1 - 0.12f * droop * t)) + side * (x * width) + up * (fold - sag);
    });
}

}  // namespace

Textures paintLeaf(uint32_t seed, int width, const LeafPaint& colors) {
    const Noise noise{seed};
    return paint({.width = width, .height = width * 2, .metres = {0.10f, 0.20f}, .repeats = false}, [&](const glm::vec2& p) {
        const float t = 1 - p.y / 0.20f, x = p.x / 0.10f - 0.5f, away = std::abs(x);
        const float half = outline(t) + 0.006f * noise.at({t * 14, x > 0 ? 1.5f : 4.5f, 0.5f});
        // Side veins leave the midrib upwards and bend along the margin.
        const float run = (t - 0.55f * away - 0.5f * away * away) * 15;
        const float vein = std::exp(-std::pow((run - std::round(run)) * 7, 2.0f)) * glm::smoothstep(0.5f, 0.2f, away);
        const float midrib = std::exp(-std::pow(away / (0.022f * (1.2f - t)), 2.0f));
        const float mottle = noise.fractal(glm::vec3(p * 90.0f, 0.5f), 4);
        Surface s;
        s.color = glm::mix(colors.shade, colors.light, glm::smoothstep(-0.4f, 0.4f, mottle));
        s.color = glm::mix(s.color, colors.vein, std::max(0.40f * vein, 0.85f * midrib));
        s.color *= 1 - 0.3f * glm::smoothstep(0.06f, 0.0f, half - away);
        s.roughness = 0.33f + 0.08f * mottle + 0.1f * midrib;
        s.height = 9e-4f * midrib - 4e-4f * vein + 1e-4f * mottle;
        const float inside = (half - away) * float(width);  // texels; the ramp is two wide, so that the cut is smooth
        s.alpha = std::max(glm::clamp(0.5f + inside * 0.5f, 0.0f, 1.0f), away < 0.014f && t < 0.08f ? 1.0f : 0.0f);
        return s;
    });
}

Model rubberFig(const std::string& name, uint32_t seed, float height, int leaves, const PlantMaterials& materials) {
    Random random(seed);
    Model plant{name, {}};
    struct Stem {
        glm::vec3 from, lean;
        float height;
    };
    const int stems = height > 0.6f ? 4 : 2;
    std::vector<Stem> all;
    for (int i = 0; i < stems; ++i) {
        const float a = tau * (float(i) + random.next()) / float(stems);
        all.push_back({{0.04f * std::cos(a), 0, 0.04f * std::sin(a)},
                       glm::vec3(std::cos(a), 0, std::sin(a)) * random.between(0.10f, 0.24f),
                       height * random.between(0.72f, 1.0f)});
    }
    const auto at = [](const Stem& s, float t) { return s.from + s.height * (s.lean * t * t + glm::vec3(0, t, 0)); };
    for (const Stem& s : all) {
        std::vector<Station> stations;
        for (int k = 0; k <= 10; ++k) stations.push_back({at(s, float(k) / 10), height * glm::mix(0.011f, 0.004f, float(k) / 10)});
        plant.add(materials.stem, tube(stations, 9));
    }
    for (int i = 0; i < leaves; ++i) {
        const Stem& s = all[size_t(i % stems)];
        const float t = glm::mix(0.24f, 1.0f, std::sqrt((float(i / stems) + random.next()) / float(leaves / stems + 1)));
        // The golden angle keeps leaves out of each other's light.
        const float a = float(i / stems) * 2.39996323f + random.between(-0.3f, 0.3f);
        const glm::vec3 out(std::cos(a), 0, std::sin(a));
        const float rise = glm::mix(-0.15f, 1.1f, t * t) + random.between(-0.15f, 0.15f);
        const glm::vec3 along = glm::normalize(out + glm::vec3(0, rise, 0)), root = at(s, t);
        // A young plant has few leaves, large for its height.
        const float length = height * (height < 0.6f ? 1.9f : 1.0f) * random.between(0.15f, 0.21f) * (1.15f - 0.35f * t);
        const glm::vec3 stalk = root + along * length * 0.22f;
        const Station petiole[] = {{root, height * 0.0032f}, {stalk, height * 0.0022f}};
        plant.add(materials.stem, tube(petiole, 6));
        plant.add(materials.leaf,
                  leafMesh(stalk, along, glm::normalize(glm::vec3(0, 1, 0) - out * 0.3f), length, random.between(0.15f, 0.45f)));
    }
    return plant;
}

Model twigs(const std::string& name, uint32_t seed, float length, int count, const PlantMaterials& materials) {
    Random random(seed);
    Model plant{name, {}};
    for (int i = 0; i < count; ++i) {
        const float a = tau * (float(i) + 0.6f * random.next()) / float(count), reach = random.between(0.35f, 0.85f),
                    size = length * random.between(0.75f, 1.1f);
        const glm::vec3 lean = glm::vec3(std::cos(a), 0, std::sin(a)) * reach;
        const auto at = [&](float t) { return size * (glm::vec3(0, t, 0) + lean * t * t * 0.8f); };
        std::vector<Station> stations;
        for (int k = 0; k <= 8; ++k) stations.push_back({at(float(k) / 8), glm::mix(0.0035f, 0.0012f, float(k) / 8)});
        plant.add(materials.stem, tube(stations, 6));
        for (int k = 0; k < 9; ++k) {
            const float t = 0.45f + 0.55f * (float(k) + 0.5f * random.next()) / 9, b = float(k) * 2.39996323f + a;
            const glm::vec3 out = glm::normalize(glm::vec3(std::cos(b), random.between(0.2f, 0.9f), std::sin(b)));
            plant.add(materials.leaf, leafMesh(at(t), out, glm::normalize(glm::vec3(-out.x * 0.5f, 1, -out.z * 0.5f)),
                                               random.between(0.05f, 0.085f), random.between(0.1f, 0.4f)));
        }
    }
    return plant;
}

Model bush(const std::string& name, uint32_t seed, float height, const BushMaterials& materials) {
    Random random(seed);
    Model plant{name, {}};
    int leaves = 0;
    const auto away = [&](const glm::vec3& along, float turn, float lean) {
        const glm::vec3 side = glm::normalize(glm::cross(along, std::abs(along.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
        return glm::normalize(std::cos(lean) * along + std::sin(lean) * (std::cos(turn) * side + std::sin(turn) * glm::cross(along, side)));
    };
    const auto leaf = [&](const glm::vec3& root, const glm::vec3& along) {
        const glm::vec3 face = glm::normalize(glm::vec3(-0.4f * along.x, 1, -0.4f * along.z) + 0.35f * glm::vec3(random.bell(), random.bell(), random.bell()));
        if (std::abs(glm::dot(face, along)) > 0.97f) return;  // no side is left to it
        plant.add(materials.leaves[size_t(leaves++) % materials.leaves.size()],
                  leafMesh(root, along, face, height * random.between(0.075f, 0.115f), random.between(0.1f, 0.4f), {2, 4}));
    };
    // A shoot bends upwards; along it stand shoots of the next order, or leaves in golden angles.
    const auto grow = [&](auto&& self, const glm::vec3& root, const glm::vec3& heading, float length, float radius, int order) -> void {
        constexpr int steps = 6;
        std::vector<Station> stations{{root, radius}};
        std::vector<glm::vec3> along{heading};
        for (int i = 1; i <= steps; ++i) {
            along.push_back(glm::normalize(along.back() + glm::vec3(0.10f * random.bell(), 0.10f, 0.10f * random.bell())));
            stations.push_back({stations.back().position + along.back() * (length / steps), radius * (1 - 0.7f * float(i) / steps)});
        }
        plant.add(materials.bark, tube(stations, order == 0 ? 8 : 5));
        const int shoots = order == 0 ? 9 : order == 1 ? 4 : 7;
        const float first = order == 0 ? 0.30f : order == 1 ? 0.25f : 0.15f, start = random.between(0, tau);
        for (int i = 0; i < shoots; ++i) {
            const float t = glm::mix(first, 1.0f, (float(i) + random.next()) / float(shoots)) * steps;
            const auto k = std::min(size_t(t), size_t(steps - 1));
            const glm::vec3 from = glm::mix(stations[k].position, stations[k + 1].position, t - float(k));
            const glm::vec3 out = away(along[k + 1], start + 2.39996323f * float(i), random.between(0.6f, 1.0f));
            if (order < 2)
                self(self, from, out, length * (order == 0 ? 0.42f : 0.48f) * random.between(0.8f, 1.2f), radius * 0.42f, order + 1);
            else
                leaf(from, out);
        }
        leaf(stations.back().position, along.back());
    };
    constexpr int stems = 6;
    for (int i = 0; i < stems; ++i) {
        const float a = tau * (float(i) + 0.6f * random.next()) / stems, lean = random.between(0.18f, 0.62f);
        const glm::vec3 out(std::cos(a), 0, std::sin(a));
        grow(grow, height * 0.03f * out, glm::normalize(glm::vec3(0, 1, 0) * std::cos(lean) + out * std::sin(lean)), height * random.between(0.52f, 0.66f),
             height * 0.016f, 0);
    }
    return plant;
}

}  // namespace lodestir::generate
