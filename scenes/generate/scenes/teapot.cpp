// SPDX-License-Identifier: MIT
// A celadon teapot by itself: turned body and lid, swept spout and handle; its ornaments are all in the normal picture, its glaze pools in them and crackles.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "kit/backdrop.h"
#include "kit/metals.h"
#include "kit/noise.h"
#include "kit/random.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/spline.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 2 * std::numbers::pi_v<float>;

/// What is cut into the clay at a place, and whether it was gilded after.
struct Ornament {
    float height = 0;  ///< 0 in the ground, 1 on top
    float gilt = 0;
};

float hump(float x) { return glm::smoothstep(0.0f, 1.0f, std::clamp(x, 0.0f, 1.0f)); }

/// Overlapping petals: x counts them, y runs from their root (0) to past their tip (1).
float petals(float x, float y) {
    const auto row = [&](float shift, float length) {
        const float away = std::abs(x + shift - std::floor(x + shift) - 0.5f), t = y / length;
        const float edge = t < 1 ? 0.5f * std::sqrt(1 - std::pow(t, 2.4f)) - away : -1;
        const float rib = std::exp(-std::pow(away / 0.045f, 2.0f)) * (1 - t);
        return edge > 0 ? hump(edge / 0.10f) - 0.35f * std::exp(-std::pow((edge - 0.16f) / 0.03f, 2.0f)) + 0.3f * rib : 0.0f;
    };
    const float front = row(0, 0.86f);
    return front > 0 ? front : 0.6f * row(0.5f, 1.0f);
}

/// A row of round beads, one a unit of x.
float beads(float x, float y) {
    const float r = glm::length(glm::vec2(x - std::floor(x) - 0.5f, y - 0.5f)) / 0.42f;
    return r < 1 ? std::sqrt(1 - r * r) : 0.0f;
}

/// Peonies in staggered rows on a lattice of fine lines; x and y count flowers.
float blossoms(float x, float y) {
    const float row = std::floor(y), column = x + 0.5f * std::fmod(row + 8, 2.0f);
    const glm::vec2 q(column - std::floor(column) - 0.5f, y - row - 0.5f);
    const float r = glm::length(q), a = std::atan2(q.y, q.x) + 0.4f * row;
    const float inner = 0.20f + 0.03f * std::cos(6 * a), outer = 0.37f + 0.055f * std::cos(6 * a + tau / 2);
    float height = 0;
    if (r < outer) height = 0.55f * hump((outer - r) / 0.07f) + 0.18f * std::cos(18 * a) * hump((r - inner) / 0.05f) * hump((outer - r) / 0.05f);
    if (r < inner) height = 0.80f * hump((inner - r) / 0.05f);
    if (r < 0.085f) height = 0.55f + 0.4f * std::sqrt(1 - r * r / (0.085f * 0.085f));
    if (r >= outer) {
        const auto line = [](float t) { return std::exp(-std::pow((t - std::round(t)) / 0.10f, 2.0f)); };
        height = 0.30f * std::max(line(6 * (x + 0.5f * y)), line(6 * (x - 0.5f * y))) * hump((r - outer) / 0.05f);
    }
    return height;
}

/// Scales, each over the next: x and y count them.
float scales(float x, float y) {
    float best = 0;
    for (int k = 0; k < 2; ++k) {
        const float row = std::floor(y) + float(k), column = x + 0.5f * std::fmod(row + 64, 2.0f);
        const glm::vec2 q(column - std::floor(column) - 0.5f, y - row);
        const float r = glm::length(q * glm::vec2(1.7f, 1)) / 1.05f;
        if (r < 1) best = std::max(best, (0.55f + 0.45f * (1 - float(k))) * hump((1 - r) / 0.25f) * (0.6f + 0.4f * r));
    }
    return best;
}

/// The glaze over an ornament: thin and pale on edges, pooled and deep in hollows; crackled, and dulled in clouds.
Surface glaze(const Ornament& ornament, const glm::vec3& p, float relief) {
    const Noise noise{41};
    const float cloud = noise.fractal(p * 3.0f, 5, 0.6f), pool = 1 - std::clamp(ornament.height, 0.0f, 1.0f);
    const Cell cell = noise.cell(p * 11.0f + 0.35f * glm::vec3(noise.at(p * 6.0f), noise.at(p * 6.0f + 7.0f), noise.at(p * 6.0f + 15.0f)));
    const float crack = std::exp(-std::pow((cell.second - cell.nearest) / 0.028f, 2.0f));
    const float speck = glm::smoothstep(0.45f, 0.6f, noise.fractal(p * 34.0f, 2));
    Surface s;
    s.color = glm::mix(glm::vec3(0.54f, 0.64f, 0.49f), glm::vec3(0.085f, 0.26f, 0.185f), 0.15f + 0.75f * pool);
    s.color *= 1 + 0.14f * cloud;
    s.color = glm::mix(s.color, glm::vec3(0.10f, 0.09f, 0.055f), 0.45f * crack + 0.35f * speck);
    s.roughness = 0.32f + 0.22f * cloud + 0.08f * crack + 0.08f * unit(hash(cell.id, 2));
    s.height = relief * ornament.height - 0.0006f * crack;
    s.color = glm::mix(s.color, gold * (0.86f + 0.1f * cloud), ornament.gilt), s.metalness = ornament.gilt;
    s.roughness = std::clamp(glm::mix(s.roughness, 0.27f + 0.1f * cloud, ornament.gilt), 0.2f, 0.5f);
    return s;
}

/// A thing turned around +y from a profile of (radius, height), and its ornament by turns around (u) and length along the profile (v, both [0, 1]).
template <class Pattern> void addTurned(Glb& glb, Model& model, const char* name, std::span<const glm::vec2> control, int columns, const Pattern& pattern) {
    const std::vector<glm::vec2> profile = smoothCurve(control, 16);
    std::vector<float> length{0};
    float widest = 0;
    for (size_t i = 1; i < profile.size(); ++i)
        length.push_back(length.back() + glm::distance(profile[i - 1], profile[i])), widest = std::max(widest, profile[i].x);
    const auto textures = paint({.width = 2048, .height = 1024, .metres = {tau * widest, length.back()}}, [&](const glm::vec2& p) {
        const float u = p.x / (tau * widest), v = p.y / length.back();
        const auto i = size_t(std::clamp(std::ranges::upper_bound(length, p.y) - length.begin(), std::ptrdiff_t(1), std::ptrdiff_t(length.size() - 1)));
        const glm::vec2 at = glm::mix(profile[i - 1], profile[i], (p.y - length[i - 1]) / (length[i] - length[i - 1]));
        return glaze(pattern(u, v), {at.x * std::sin(tau * u), at.y, at.x * std::cos(tau * u)}, 0.012f);
    });
    Mesh mesh = turned(profile, columns, 180);
    model.add(glb.addMaterial(glb.dressed({.name = name}, textures)), mesh);
}

/// A band of v from low to high: where v lies in it, [0, 1]; elsewhere below 0.
float within(float v, float low, float high) { return v >= low && v <= high ? (v - low) / (high - low) : -1.0f; }

Ornament bodyOrnament(float u, float v) {
    Ornament o;
    const auto band = [&](float low, float high, auto&& pattern) {
        if (const float y = within(v, low, high); y >= 0) pattern(y);
    };
    const auto ring = [&](float at, float width) {
        const float t = std::abs(v - at) / width;
        if (t < 1) o = {std::sqrt(1 - t * t), glm::smoothstep(1.0f, 0.8f, t)};
    };
    band(0.115f, 0.155f, [&](float y) { o.height = 0.9f * beads(64 * u, y); });
    band(0.17f, 0.33f, [&](float y) { o.height = petals(20 * u, y); });
    band(0.35f, 0.70f, [&](float y) { o.height = blossoms(14 * u, 2 * y); });
    band(0.72f, 0.87f, [&](float y) { o.height = petals(24 * u, 1 - y); });
    for (const auto& [at, width] : {std::pair{0.10f, 0.010f}, {0.162f, 0.006f}, {0.340f, 0.007f}, {0.710f, 0.007f}, {0.885f, 0.012f}}) ring(at, width);
    return o;
}

Ornament lidOrnament(float u, float v) {
    Ornament o;
    if (const float y = within(v, 0.0f, 0.27f); y >= 0) o = {0.7f * petals(8 * u, y), y < 0.30f ? 1.0f : 0.0f};
    if (const float y = within(v, 0.36f, 0.74f); y >= 0) o.height = petals(16 * u, y);
    if (const float y = within(v, 0.77f, 0.86f); y >= 0) o.height = 0.9f * beads(44 * u, y);
    if (const float t = std::abs(v - 0.92f) / 0.05f; t < 1) o = {std::sqrt(1 - t * t), 1};
    return o;
}

/// Spout and handle in scales; u around in metres, v along.
void addLimbs(Glb& glb, Model& model) {
    constexpr glm::vec2 tile{0.24f, 0.24f};
    const auto textures = paint({.width = 1024, .height = 1024, .metres = tile}, [&](const glm::vec2& p) {
        // The noise of the glaze runs on a cylinder in both directions, so that the tile repeats.
        const glm::vec2 a = p / tile * tau;
        return glaze({0.9f * scales(8 * p.x / tile.x, 8 * p.y / tile.y), 0}, 0.12f * glm::vec3(std::sin(a.x) + 3, std::cos(a.x) * std::sin(a.y), std::cos(a.y)),
                     0.004f);
    });
    const int material = glb.addMaterial(glb.dressed({.name = "limbs"}, textures));
    const Station spout[] = {{{0.40f, 0.26f, 0}, 0.135f}, {{0.60f, 0.31f, 0}, 0.112f},  {{0.74f, 0.46f, 0}, 0.080f},
                             {{0.81f, 0.62f, 0}, 0.060f}, {{0.89f, 0.735f, 0}, 0.052f}, {{0.95f, 0.79f, 0}, 0.054f}};
    const Station handle[] = {{{-0.38f, 0.655f, 0}, 0.040f}, {{-0.58f, 0.735f, 0}, 0.046f}, {{-0.78f, 0.67f, 0}, 0.047f}, {{-0.845f, 0.50f, 0}, 0.046f},
                              {{-0.76f, 0.32f, 0}, 0.044f},  {{-0.62f, 0.235f, 0}, 0.042f}, {{-0.46f, 0.23f, 0}, 0.040f}};
    for (const auto& stations : {std::span<const Station>(spout), std::span<const Station>(handle)}) {
        Mesh mesh = limb(stations, 16, 64);
        // A whole number of tiles around, or the scales would not meet.
        const float girth = tau * std::max(stations.front().radius, stations.back().radius);
        scaleUv(mesh, {std::round(4 * girth / tile.x) / 4 / girth, 1 / tile.y});
        model.add(material, mesh);
    }
}

Glb makeTeapot() {
    Glb glb;
    Model model{"teapot", {}};
    const glm::vec2 body[] = {{0.335f, 0.770f}, {0.365f, 0.785f}, {0.385f, 0.765f}, {0.40f, 0.735f},  {0.47f, 0.64f},   {0.535f, 0.52f}, {0.56f, 0.39f},
                              {0.535f, 0.26f},  {0.465f, 0.145f}, {0.375f, 0.075f}, {0.355f, 0.045f}, {0.375f, 0.015f}, {0.36f, 0.0f},   {0.0f, 0.0f}};
    addTurned(glb, model, "body", body, 256, bodyOrnament);
    const glm::vec2 lid[] = {{0, 1.04f},      {0.045f, 1.03f}, {0.075f, 0.985f}, {0.065f, 0.93f}, {0.035f, 0.90f}, {0.06f, 0.88f},
                             {0.18f, 0.865f}, {0.28f, 0.83f},  {0.335f, 0.79f},  {0.34f, 0.765f}, {0.30f, 0.755f}, {0, 0.755f}};
    addTurned(glb, model, "lid", lid, 192, lidOrnament);
    addLimbs(glb, model);
    glb.addNode(model);
    addLamp(glb, {0.05f, 0.5f, 0}, 0.95f, {10, 9.4f, 8.6f});
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeTeapot, "--levels 4 --mesh teapot")

}  // namespace lodestir::generate
