// SPDX-License-Identifier: MIT
// Cliffs: see cliff.h.
#include "cliff.h"

#include <algorithm>
#include <cmath>

#include "figure.h"
#include "landscape.h"
#include "random.h"
#include "shapes.h"

namespace lodestir::generate {

namespace {

constexpr int columns = 480, rows = 210;
constexpr float top = 38, bottom = -4;             ///< heights of the face, metres
constexpr float inland = 140;                      ///< depth of the meadow
constexpr float edgeRow = 0.20f, footRow = 0.93f;  ///< shares of the rows: meadow, face, what lies under water
constexpr float lean = 7;                          ///< metres by which the foot stands before the edge

float hill(float z, float middle, float width) { return std::exp(-std::pow((z - middle) / width, 2.0f)); }

}  // namespace

float Cliff::edge(float z) const {
    const float coves = 15 + 20 * hill(z, -62, 34) - 44 * hill(z, -150, 34) + 30 * hill(z, -235, 45);
    return coves + 5 * noise.fractal({z * 0.035f, 0.5f, 3.5f}, 3);
}

float Cliff::meadow(const glm::vec2& xz) const {
    const float away = std::max(xz.x - edge(xz.y), 0.0f);
    return top + 0.10f * away + 2.2f * noise.fractal({xz.x * 0.03f, 7.5f, xz.y * 0.03f}, 4) * glm::smoothstep(0.0f, 12.0f, away) -
           2.5f * std::exp(-away / 2.5f);
}

float Cliff::layer(const glm::vec3& p) const { return (p.y + 0.06f * p.z + 0.9f * noise.fractal(p * 0.05f + 4.0f, 3)) / 2.1f; }

/// Metres that the face stands out from where it would be: beds of different hardness, gullies, blocks that fell.
float Cliff::weathering(const glm::vec3& p) const {
    const glm::vec3 q = p + 1.6f * glm::vec3(noise.at(p * 0.13f), noise.at(p * 0.13f + 17.3f), noise.at(p * 0.13f + 41.9f));
    const float bed = std::floor(layer(q)), within = layer(q) - bed;
    const auto hardness = [&](float k) { return unit(hash(noise.seed, uint32_t(int(k) + 1000))); };
    const float strata = glm::mix(hardness(bed), hardness(bed + 1), glm::smoothstep(0.7f, 1.0f, within)) - 0.5f;
    const float gullies = noise.ridged({q.x * 0.03f, q.y * 0.007f, q.z * 0.036f}, 3), chutes = noise.ridged({q.x * 0.10f, q.y * 0.022f, q.z * 0.13f + 5}, 3);
    const glm::vec3 joints(q.x * 0.22f, q.y * 0.26f, q.z * 0.22f);
    const Cell block = noise.cell(joints);
    const float fallen = unit(hash(block.id, 3)) - 0.5f, crack = 1 - glm::smoothstep(0.0f, 0.16f, block.second - block.nearest);
    return 1.9f * strata - 7.0f * (gullies - 0.35f) - 2.2f * (chutes - 0.35f) + 2.0f * fallen - 0.5f * crack + 0.7f * noise.fractal(q * 0.6f, 4, 0.55f);
}

glm::vec3 Cliff::at(float u, float v) const {
    // Columns and rows gather where the picture shows them large: near by, and on the face.
    const float z = glm::mix(nearEnd, farEnd, 0.35f * u + 0.65f * u * u), x = edge(z);
    const float slope = (edge(z + 2) - edge(z - 2)) / 4;
    const glm::vec3 out = glm::normalize(glm::vec3(-1, 0, slope));
    if (v <= edgeRow) {
        const float t = 1 - v / edgeRow, away = 4 * t + (inland - 4) * t * t * t;
        const glm::vec3 rim(x, top, z);
        const float ragged = weathering(rim) * std::exp(-away / 3);
        return glm::vec3(x + away, meadow({x + away, z}), z) + out * ragged;
    }
    const float t = std::min((v - edgeRow) / (footRow - edgeRow), 1.0f), y = glm::mix(meadow({x, z}), bottom, t);
    const glm::vec3 plain = glm::vec3(x, y, z) + out * (lean * (0.25f * t + 0.75f * t * t * t));
    const float beach = v > footRow ? 26 * (v - footRow) / (1 - footRow) : 0;
    return plain + out * (weathering(plain) * (1 - 0.5f * glm::smoothstep(0.85f, 1.0f, t)) + beach) - glm::vec3(0, 0.15f * beach, 0);
}

Surface Cliff::surface(const glm::vec3& p, const glm::vec3& n) const {
    const float fine = noise.fractal(p * 1.7f, 4, 0.6f), broad = noise.fractal(p * 0.09f + 11.0f, 3), grain = noise.fractal(p * 6.0f, 2, 0.7f);
    const float bed = layer(p) * 2.3f + 0.35f * fine, number = std::floor(bed), within = bed - number;
    const auto tone = [&](float k) { return unit(hash(noise.seed + 7, uint32_t(int(k) + 1000))); };
    const float band = glm::mix(tone(number), tone(number + 1), glm::smoothstep(0.55f, 1.0f, within));
    Surface s;
    s.color = glm::mix(glm::vec3(0.40f, 0.315f, 0.215f), glm::vec3(0.235f, 0.175f, 0.13f), band);
    s.color = glm::mix(s.color, glm::vec3(0.42f, 0.20f, 0.09f), 0.55f * glm::smoothstep(0.0f, 0.45f, broad + 0.3f * fine));  // iron
    // Water runs down over the edge and leaves dark streaks.
    const float streak = noise.fractal({p.x * 0.5f, p.y * 0.03f, p.z * 0.5f}, 4, 0.6f);
    s.color *= 1 - 0.35f * glm::smoothstep(0.1f, 0.5f, streak);
    s.color *= 1 + 0.35f * fine + 0.25f * grain;
    s.roughness = 0.9f;
    s.height = 0.14f * fine + 0.05f * grain;

    // Grass on what lies flat enough, above the reach of salt.
    const float grows = glm::smoothstep(0.52f, 0.74f, n.y + 0.16f * fine) * glm::smoothstep(11.0f, 17.0f, p.y + 4 * broad);
    const float patch = noise.fractal(p * 0.16f + 5.0f, 4, 0.6f);
    const glm::vec3 grass = glm::mix(glm::vec3(0.135f, 0.165f, 0.04f), glm::vec3(0.32f, 0.27f, 0.10f), glm::smoothstep(-0.35f, 0.4f, patch + 0.3f * grain));
    cover(s, grass * (1 + 0.3f * grain), 0.95f, grows);
    // What the tide wets is dark; weed grows on it.
    const float wet = glm::smoothstep(3.4f, 1.6f, p.y + 1.2f * fine), weed = glm::smoothstep(1.5f, 0.5f, p.y + 0.8f * broad + 0.8f * fine);
    s.color = glm::mix(s.color, s.color * 0.32f, wet);
    s.color = glm::mix(s.color, glm::vec3(0.03f, 0.035f, 0.012f), 0.8f * weed);
    s.roughness = glm::mix(s.roughness, 0.38f, wet);
    s.color = glm::max(s.color, glm::vec3(0.004f));
    return s;
}

Model Cliff::model(Glb& glb, const std::string& name) const {
    const Mesh mesh = grid(columns, rows, [&](float u, float v) { return at(u, v); });
    const Lattice lattice(mesh, columns, rows);
    const Textures pictures =
        paintLattice(lattice, {2048, 1024}, {nearEnd - farEnd, 66}, [&](const Lattice::Point& point) { return surface(point.position, point.normal); });
    Model model{name, {}};
    model.add(glb.addMaterial(glb.dressed({.name = name}, pictures)), mesh);
    return model;
}

}  // namespace lodestir::generate
