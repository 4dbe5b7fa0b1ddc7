// SPDX-License-Identifier: MIT
// A mourner in a hooded cloak: see mourner.h. Shapes are exact or underestimated distances, joined by polynomial smooth minima
// (Quilez, "Smooth minimum", 2013).
#include "mourner.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lodestir::generate {

namespace {

constexpr float pi = 3.14159265f;

float joined(float a, float b, float width) {
    const float h = std::max(width - std::abs(a - b), 0.0f) / width;
    return std::min(a, b) - 0.25f * width * h * h;
}

float cut(float a, float b, float width) { return -joined(-a, b, width); }

/// Bound of the distance to an ellipsoid (Quilez, "Ellipsoid distance").
float ellipsoid(const glm::vec3& p, const glm::vec3& center, const glm::vec3& radii) {
    const glm::vec3 q = p - center;
    const float k = glm::length(q / radii), l = glm::length(q / (radii * radii));
    return l > 1e-6f ? k * (k - 1) / l : -std::min({radii.x, radii.y, radii.z});
}

/// A rod from a to b whose radius changes along it.
float rod(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, float ra, float rb) {
    const glm::vec3 along = b - a;
    const float t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0f, 1.0f);
    return glm::length(p - a - t * along) - glm::mix(ra, rb, t);
}

/// A value between keys (y, value), smooth.
template <size_t N> float along(const std::array<glm::vec2, N>& keys, float y) {
    if (y <= keys.front().x) return keys.front().y;
    for (size_t i = 0; i + 1 < N; ++i)
        if (y < keys[i + 1].x) {
            const float t = (y - keys[i].x) / (keys[i + 1].x - keys[i].x);
            const auto slope = [&](size_t k) {
                const size_t before = k > 0 ? k - 1 : 0, after = std::min(k + 1, N - 1);
                return (keys[after].y - keys[before].y) / (keys[after].x - keys[before].x) * (keys[i + 1].x - keys[i].x);
            };
            const float t2 = t * t, t3 = t2 * t;
            return (2 * t3 - 3 * t2 + 1) * keys[i].y + (t3 - 2 * t2 + t) * slope(i) + (3 * t2 - 2 * t3) * keys[i + 1].y + (t3 - t2) * slope(i + 1);
        }
    return keys.back().y;
}

constexpr std::array<glm::vec2, 9> halfWidth{{{0.16f, 0.375f}, {0.30f, 0.335f}, {0.55f, 0.290f}, {0.85f, 0.262f}, {1.10f, 0.255f}, {1.32f, 0.262f},
                                              {1.46f, 0.225f}, {1.56f, 0.140f}, {1.66f, 0.085f}}};
constexpr std::array<glm::vec2, 9> halfDepth{{{0.16f, 0.345f}, {0.30f, 0.290f}, {0.55f, 0.235f}, {0.85f, 0.198f}, {1.10f, 0.180f}, {1.32f, 0.172f},
                                              {1.46f, 0.150f}, {1.56f, 0.105f}, {1.66f, 0.080f}}};
constexpr std::array<glm::vec2, 5> lean{{{0.16f, 0.0f}, {0.7f, -0.015f}, {1.2f, -0.02f}, {1.45f, 0.015f}, {1.66f, 0.07f}}};

glm::vec3 mirrored(const glm::vec3& p) { return {std::abs(p.x), p.y, p.z}; }

/// A fold in cross section: narrow rounded crests between wide troughs.
float crest(float phase, float sharpness) { return std::pow(0.5f + 0.5f * std::cos(phase), sharpness); }

}  // namespace

float Mourner::folds(const glm::vec3& p) const {
    const float angle = std::atan2(p.x, p.z - along(lean, p.y));
    const float fall = std::clamp((1.50f - p.y) / 1.34f, 0.0f, 1.0f);  // 0 at the shoulders, 1 at the hem
    const float sway = 0.55f * noise.at({2.2f * std::cos(angle), 1.1f * p.y, 2.2f * std::sin(angle)});
    const float swell = noise.at({1.7f * std::cos(angle) + 9, 0.8f * p.y, 1.7f * std::sin(angle)});
    const float large = crest(8 * angle + 2.2f * sway + 0.7f * fall, 1.5f), middle = crest(15 * angle - 3.5f * sway + 1.3f + 1.5f * swell, 1.3f),
                small = crest(26 * angle + 5.0f * sway + 4.0f * swell, 1.2f);
    const float depth = fall * fall * (3 - 2 * fall);
    return (0.006f + 0.062f * depth) * (large - 0.4f) * (0.75f + 0.45f * swell) + (0.003f + 0.026f * depth) * (middle - 0.4f) +
           (0.0015f + 0.007f * depth) * (small - 0.4f);
}

float Mourner::cloak(const glm::vec3& p) const {
    const float width = along(halfWidth, p.y), depth = along(halfDepth, p.y);
    const glm::vec2 q(p.x, p.z - along(lean, p.y)), radii(width, depth);
    const float k = glm::length(q / radii), l = glm::length(q / (radii * radii));
    float d = l > 1e-6f ? k * (k - 1) / l : -depth;
    // The right half lies over the left one: its edge falls from the throat to the left of the feet.
    if (q.y > 0) {
        const float edge = q.x + 0.10f * (1.45f - p.y) + 0.012f * std::sin(9 * p.y) - 0.01f;
        const float over = glm::smoothstep(-0.006f, 0.006f, edge) * glm::smoothstep(1.50f, 1.30f, p.y) * glm::smoothstep(0.16f, 0.05f, edge);
        d -= 0.016f * over;
    }
    d -= folds(p);
    d = std::max(d, p.y - 1.66f);
    return 0.62f * std::max(d, 0.155f + 0.006f * std::sin(7 * std::atan2(p.x, p.z)) - p.y);  // folds are steep: the bound holds for their slope
}

float Mourner::hood(const glm::vec3& p) const {
    float d = ellipsoid(p, {0, 1.715f, 0.050f}, {0.128f, 0.172f, 0.165f});
    d = joined(d, rod(p, {0, 1.80f, -0.02f}, {0, 1.70f, -0.155f}, 0.075f, 0.035f), 0.10f);             // its point falls back
    d = joined(d, ellipsoid(p, {0, 1.52f, 0.01f}, {0.225f, 0.120f, 0.165f}), 0.11f);                    // cowl on the shoulders
    d = joined(d, rod(mirrored(p), {0.095f, 1.62f, 0.13f}, {0.012f, 1.475f, 0.185f}, 0.036f, 0.030f), 0.06f);  // its hem under the chin
    // Cloth that is drawn from the brow to the nape and sags on the shoulders.
    const glm::vec2 pole(p.z - 0.16f, p.y - 1.60f);
    const float turn = std::atan2(pole.y, -pole.x), reach = glm::length(pole);
    const float sway = noise.at({7 * p.x, 5 * p.y, 5 * p.z});
    d -= 0.0120f * glm::smoothstep(0.05f, 0.16f, reach) * (crest(11 * turn + 2.5f * sway + 14 * std::abs(p.x), 1.4f) - 0.4f);
    d -= 0.0075f * glm::smoothstep(1.60f, 1.50f, p.y) * (crest(95 * (p.y + 0.55f * p.x * p.x + 0.25f * p.z) + 3 * sway, 1.3f) - 0.4f);
    const float opening = ellipsoid(p, {0, 1.662f, 0.215f}, {0.074f, 0.122f, 0.135f});
    const float rim = std::abs(opening - 0.004f) - 0.010f;  // a rolled edge
    d = joined(d, std::max(rim, d - 0.010f), 0.012f);
    return 0.8f * cut(d, opening, 0.012f);
}

float Mourner::face(const glm::vec3& p) const {
    const glm::vec3 q = mirrored(p);
    float d = ellipsoid(p, {0, 1.678f, 0.092f}, {0.071f, 0.105f, 0.088f});
    d = joined(d, ellipsoid(p, {0, 1.605f, 0.130f}, {0.038f, 0.034f, 0.038f}), 0.05f);                           // chin
    d = cut(d, ellipsoid(q, {0.031f, 1.694f, 0.190f}, {0.022f, 0.014f, 0.022f}), 0.020f);                       // sockets
    d = joined(d, ellipsoid(q, {0.030f, 1.692f, 0.153f}, {0.016f, 0.012f, 0.014f}), 0.004f);                     // lids, lowered
    d = joined(d, rod(p, {0, 1.712f, 0.170f}, {0, 1.660f, 0.196f}, 0.008f, 0.012f), 0.022f);                     // nose
    d = joined(d, ellipsoid(q, {0.011f, 1.657f, 0.188f}, {0.009f, 0.007f, 0.010f}), 0.008f);
    d = joined(d, rod(q, {0, 1.635f, 0.176f}, {0.017f, 1.631f, 0.168f}, 0.0065f, 0.003f), 0.008f);               // lips
    d = joined(d, rod(q, {0, 1.624f, 0.174f}, {0.015f, 1.628f, 0.167f}, 0.0070f, 0.003f), 0.007f);
    return 0.85f * d;
}

float Mourner::arms(const glm::vec3& p) const {
    const glm::vec3 q = mirrored(p), elbow(0.285f, 1.10f, 0.035f), cuff(0.075f, 1.155f, 0.235f);
    float d = rod(q, {0.195f, 1.40f, -0.005f}, elbow, 0.088f, 0.092f);
    const float forearm = rod(q, elbow, cuff, 0.092f, 0.082f);
    d = joined(d, forearm, 0.05f);
    // The sleeve hangs in a bag from the forearm.
    d = joined(d, rod(q, {0.235f, 0.98f, 0.10f}, {0.115f, 0.90f, 0.215f}, 0.040f, 0.052f), 0.16f);
    const glm::vec3 down = glm::normalize(cuff - elbow);
    const float place = glm::dot(q - elbow, down), sway = noise.at(6.0f * p + glm::vec3(3));
    d -= 0.016f * (crest(46 * place + 22 * (q.y - 1.1f) + 2.4f * sway, 1.6f) - 0.35f) * glm::smoothstep(1.42f, 1.25f, p.y);
    d -= 0.008f * (crest(70 * q.y - 38 * q.z + 3 * sway, 1.3f) - 0.35f) * glm::smoothstep(1.40f, 1.30f, p.y) * glm::smoothstep(1.02f, 1.12f, p.y);
    d = cut(d, rod(q, cuff + 0.045f * down, cuff - 0.05f * down, 0.060f, 0.050f), 0.010f);  // its opening
    return 0.6f * d;
}

float Mourner::hands(const glm::vec3& p) const {
    const glm::vec3 q = mirrored(p);
    float d = rod(q, {0.105f, 1.150f, 0.205f}, {0.045f, 1.185f, 0.262f}, 0.030f, 0.026f);  // wrists
    d = joined(d, ellipsoid(q, {0.022f, 1.215f, 0.275f}, {0.024f, 0.048f, 0.030f}), 0.02f);
    for (int finger = 0; finger < 4; ++finger) {  // palm on palm, fingers up
        const float z = 0.296f - 0.0165f * float(finger), length = std::array{0.085f, 0.097f, 0.092f, 0.072f}[size_t(finger)];
        const glm::vec3 knuckle(0.0135f, 1.245f, z), tip(0.0105f, 1.245f + length, z + 0.012f);
        d = joined(d, rod(q, knuckle, tip, 0.0098f, 0.0075f), 0.005f);
    }
    d = joined(d, rod(q, {0.030f, 1.205f, 0.296f}, {0.014f, 1.262f, 0.312f}, 0.0115f, 0.0085f), 0.006f);  // thumbs
    return 0.9f * d;
}

float Mourner::plinth(const glm::vec3& p) const {
    const auto disc = [&](float bottom, float top, float radius, float round) {
        // Eight sides, cut with a round edge.
        glm::vec2 q(std::abs(p.x), std::abs(p.z));
        const float side = std::max({q.x, q.y, 0.70710678f * (q.x + q.y)});
        const glm::vec2 d(side - radius + round, std::abs(p.y - 0.5f * (bottom + top)) - 0.5f * (top - bottom) + round);
        return glm::length(glm::max(d, 0.0f)) + std::min(std::max(d.x, d.y), 0.0f) - round;
    };
    float d = std::min(disc(0, 0.075f, 0.54f, 0.006f), disc(0.06f, 0.165f, 0.485f, 0.010f));
    const glm::vec2 q(std::max({std::abs(p.x), std::abs(p.z), 0.70710678f * (std::abs(p.x) + std::abs(p.z))}) - 0.49f, p.y - 0.082f);
    return std::min(d, glm::length(q) - 0.018f);
}

float Mourner::relief(const glm::vec3& p) const {
    const float weather = noise.fractal(14.0f * p, 4, 0.55f), grain = noise.fractal(150.0f * p, 3, 0.6f);
    const Cell pit = noise.cell(60.0f * p);
    const float pitted = pit.id % 5u == 0 ? glm::smoothstep(0.35f, 0.0f, pit.nearest) : 0.0f;
    // A claw chisel went over the stone in short strokes.
    const float stroke = noise.at(3.0f * p) * 6, claw = std::sin(900 * p.y + 260 * std::sin(stroke) * (p.x - p.z));
    return 0.0011f * weather + 0.00035f * grain - 0.0012f * pitted + 0.00022f * claw * glm::smoothstep(-0.1f, 0.5f, noise.at(5.0f * p + glm::vec3(7)));
}

float Mourner::distance(const glm::vec3& p) const {
    constexpr float deepest = 0.004f;  // of the relief
    float d = joined(cloak(p), arms(p), 0.035f);
    d = joined(d, hood(p), 0.03f);
    d = std::min({d, face(p), hands(p)});
    d = joined(d, plinth(p), 0.006f);
    return std::abs(d) > 2 * deepest ? d - std::copysign(deepest, d) : 0.9f * (d - relief(p));
}

}  // namespace lodestir::generate
