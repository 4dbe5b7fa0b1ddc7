// SPDX-License-Identifier: MIT
// A fallow buck: see deer.h.
#include "deer.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "atlas.h"
#include "figure.h"
#include "noise.h"
#include "random.h"
#include "sculpture.h"
#include "spline.h"

namespace lodestir::generate {

namespace {

constexpr float cell = 0.0175f;  ///< metres: the thinnest shank is two and a half across

/// The head turns on its neck.
const glm::mat4 headFrame = [] {
    const glm::vec3 poll(0.70f, 1.36f, 0);
    const glm::mat4 turn = glm::rotate(glm::translate(glm::mat4(1), poll), glm::radians(-34.0f), glm::vec3(0, 1, 0));
    return glm::rotate(turn, glm::radians(7.0f), glm::vec3(1, 0, 0)) * glm::translate(glm::mat4(1), -poll);
}();

constexpr glm::vec3 eye(0.826f, 1.482f, 0.061f), nose(1.035f, 1.372f, 0);

void addTrunk(Sculpture& clay) {
    clay.slim = 0.80f, clay.blend = 0.12f;
    const Station trunk[] = {{{-0.56f, 0.93f, 0}, 0.175f}, {{-0.40f, 0.95f, 0}, 0.200f}, {{-0.12f, 0.92f, 0}, 0.205f},
                             {{0.14f, 0.90f, 0}, 0.220f},  {{0.34f, 0.93f, 0}, 0.215f},  {{0.44f, 0.98f, 0}, 0.165f}};
    clay.limb(trunk);
    const Station neck[] = {{{0.40f, 0.98f, 0}, 0.165f}, {{0.53f, 1.12f, 0}, 0.135f}, {{0.63f, 1.26f, 0}, 0.105f}, {{0.70f, 1.40f, 0}, 0.085f}};
    clay.limb(neck);
    clay.slim = 1, clay.blend = 0.03f;
    const Station tail[] = {{{-0.70f, 1.01f, 0}, 0.035f}, {{-0.78f, 0.93f, 0}, 0.040f}, {{-0.80f, 0.78f, 0}, 0.016f}};
    clay.limb(tail);
}

void addLegs(Sculpture& clay) {
    // Joints from above; the walk shifts what hangs below shoulder and hip.
    const auto leg = [&](std::initializer_list<Station> joints) {
        clay.blend = 0.08f;
        const std::vector<Station> bones(joints);
        clay.limb(std::span(bones).first(2));
        clay.blend = 0.025f;
        clay.limb(std::span(bones).subspan(1));
    };
    leg({{{0.34f, 0.88f, 0.09f}, 0.125f},
         {{0.36f, 0.66f, 0.115f}, 0.066f},
         {{0.46f, 0.42f, 0.11f}, 0.037f},
         {{0.50f, 0.385f, 0.11f}, 0.034f},
         {{0.53f, 0.13f, 0.105f}, 0.022f},
         {{0.56f, 0.08f, 0.105f}, 0.026f},
         {{0.595f, 0.03f, 0.105f}, 0.032f}});
    leg({{{0.34f, 0.88f, -0.09f}, 0.125f},
         {{0.30f, 0.66f, -0.115f}, 0.066f},
         {{0.29f, 0.42f, -0.11f}, 0.037f},
         {{0.275f, 0.37f, -0.11f}, 0.033f},
         {{0.17f, 0.13f, -0.105f}, 0.022f},
         {{0.175f, 0.075f, -0.105f}, 0.026f},
         {{0.205f, 0.03f, -0.105f}, 0.032f}});
    leg({{{-0.46f, 0.90f, 0.075f}, 0.165f},
         {{-0.40f, 0.68f, 0.12f}, 0.098f},
         {{-0.56f, 0.47f, 0.115f}, 0.044f},
         {{-0.635f, 0.43f, 0.11f}, 0.038f},
         {{-0.66f, 0.14f, 0.105f}, 0.024f},
         {{-0.64f, 0.08f, 0.105f}, 0.027f},
         {{-0.605f, 0.03f, 0.105f}, 0.032f}});
    leg({{{-0.46f, 0.90f, -0.075f}, 0.165f},
         {{-0.30f, 0.69f, -0.12f}, 0.098f},
         {{-0.34f, 0.47f, -0.115f}, 0.044f},
         {{-0.39f, 0.42f, -0.11f}, 0.038f},
         {{-0.31f, 0.14f, -0.105f}, 0.024f},
         {{-0.28f, 0.08f, -0.105f}, 0.027f},
         {{-0.245f, 0.03f, -0.105f}, 0.032f}});
}

void addHead(Sculpture& clay) {
    clay.frame = headFrame;
    clay.slim = 0.80f, clay.blend = 0.045f;
    const Station skull[] = {
        {{0.70f, 1.42f, 0}, 0.085f}, {{0.75f, 1.475f, 0}, 0.088f}, {{0.84f, 1.455f, 0}, 0.070f}, {{0.95f, 1.405f, 0}, 0.047f}, {{1.01f, 1.375f, 0}, 0.040f}};
    clay.limb(skull);
    const Station jaw[] = {{{0.75f, 1.41f, 0}, 0.070f}, {{0.88f, 1.38f, 0}, 0.042f}, {{0.99f, 1.352f, 0}, 0.028f}};
    clay.limb(jaw);
    for (float side : {-1.0f, 1.0f}) {
        clay.slim = 1;
        clay.blend = 0.018f;
        clay.lump({0.815f, 1.507f, side * 0.050f}, glm::mat3(glm::vec3(0.032f, -0.006f, 0), glm::vec3(0.003f, 0.014f, 0), glm::vec3(0, 0, 0.018f)));  // brow
        clay.blend = 0.004f;
        clay.lump(eye * glm::vec3(1, 1, side), glm::mat3(0.019f));
        // Ears stand out and back, cupped forward.
        const glm::vec3 along = glm::normalize(glm::vec3(-0.32f, 0.42f, side * 0.85f)),
                        across = glm::normalize(glm::cross(along, glm::vec3(0.8f, 0.3f, side * 0.45f))),
                        out = glm::cross(across, along) * (glm::cross(across, along).x < 0 ? -1.0f : 1.0f);
        const glm::vec3 middle = glm::vec3(0.69f, 1.50f, side * 0.055f) + 0.125f * along;
        clay.blend = 0.02f;
        clay.lump(middle, glm::mat3(0.125f * along, 0.052f * across, 0.030f * out));
        clay.blend = 0.012f;
        clay.hollow(middle + 0.031f * out + 0.008f * along, glm::mat3(0.100f * along, 0.038f * across, 0.022f * out));
        clay.blend = 0.012f;
        clay.hollow({1.042f, 1.385f, side * 0.022f}, glm::mat3(0.012f));  // nostril
    }
    clay.frame = glm::mat4(1);
}

/// A beam on each side with three tines, the last a fork.
Mesh antlers() {
    Mesh mesh;
    for (float side : {-1.0f, 1.0f}) {
        const auto branch = [&](std::initializer_list<Station> points, int steps, int sides) {
            std::vector<Station> bent;
            for (Station s : points) s.position.z *= side, bent.push_back(s);
            append(mesh, placed(limb(bent, steps, sides), headFrame));
        };
        branch({{{0.748f, 1.52f, 0.040f}, 0.030f},
                {{0.742f, 1.565f, 0.050f}, 0.034f},
                {{0.730f, 1.595f, 0.060f}, 0.025f},
                {{0.67f, 1.70f, 0.125f}, 0.022f},
                {{0.57f, 1.84f, 0.225f}, 0.020f},
                {{0.54f, 1.98f, 0.285f}, 0.017f},
                {{0.60f, 2.10f, 0.285f}, 0.012f},
                {{0.66f, 2.19f, 0.255f}, 0.003f}},
               6, 14);
        branch({{{0.735f, 1.60f, 0.062f}, 0.018f}, {{0.81f, 1.635f, 0.090f}, 0.016f}, {{0.885f, 1.70f, 0.115f}, 0.012f}, {{0.915f, 1.785f, 0.120f}, 0.003f}}, 6,
               11);
        branch({{{0.655f, 1.725f, 0.140f}, 0.016f}, {{0.72f, 1.785f, 0.185f}, 0.014f}, {{0.775f, 1.865f, 0.205f}, 0.010f}, {{0.79f, 1.935f, 0.200f}, 0.003f}},
               6, 10);
        branch({{{0.56f, 1.87f, 0.235f}, 0.014f}, {{0.48f, 1.94f, 0.275f}, 0.012f}, {{0.435f, 2.03f, 0.29f}, 0.009f}, {{0.425f, 2.11f, 0.28f}, 0.003f}}, 6, 10);
        branch({{{0.545f, 1.985f, 0.285f}, 0.014f}, {{0.515f, 2.06f, 0.32f}, 0.011f}, {{0.52f, 2.14f, 0.335f}, 0.008f}, {{0.535f, 2.205f, 0.33f}, 0.003f}}, 6,
               10);
    }
    return mesh;
}

/// What the coat is at a place: chestnut, paler below, white spots in loose rows, white behind; black nose, eyes and hooves.
Surface coat(const glm::vec3& p, const glm::vec3& n) {
    const Noise noise{71};
    const glm::vec3 q(glm::inverse(headFrame) * glm::vec4(p, 1));  // where it would be if the head looked straight on
    const float head = glm::smoothstep(1.30f, 1.42f, p.y), legs = glm::smoothstep(0.70f, 0.52f, p.y);
    const float mottle = noise.fractal(p * 5.0f, 4), hue = noise.fractal(p * 2.2f + 9.0f, 3);
    // Hair lies along the body and down the legs.
    const glm::vec3 lay = glm::mix(glm::vec3(38, 150, 150), glm::vec3(150, 38, 150), std::max(legs, head * 0.5f));
    const float hair = noise.fractal(p * lay + 0.6f * mottle, 3, 0.65f);

    Surface s;
    const float back = glm::smoothstep(0.82f, 1.08f, p.y + 0.03f * mottle), belly = glm::smoothstep(-0.15f, -0.75f, n.y + 0.25f * mottle) * (1 - head);
    s.color = glm::mix(glm::vec3(0.42f, 0.25f, 0.125f), glm::vec3(0.20f, 0.095f, 0.042f), back);
    s.color = glm::mix(s.color, glm::vec3(0.40f, 0.255f, 0.14f), 0.8f * legs);
    s.color = glm::mix(s.color, glm::vec3(0.66f, 0.55f, 0.41f), belly * (1 - 0.5f * legs));
    s.color *= 1 + 0.16f * hue;
    const float spine = std::exp(-std::pow(p.z / 0.030f, 2.0f)) * glm::smoothstep(1.02f, 1.10f, p.y) * glm::smoothstep(0.62f, 0.52f, p.x);
    s.color = glm::mix(s.color, glm::vec3(0.07f, 0.035f, 0.018f), 0.8f * spine);
    // Spots: jittered cells on the flanks, fewer towards belly and shoulder.
    const Cell spot = Noise{72}.cell(p * glm::vec3(15.5f, 17, 12) + 0.3f * glm::vec3(mottle));
    const float flank = glm::smoothstep(0.77f, 0.84f, p.y) * glm::smoothstep(0.50f, 0.38f, p.x) * (1 - spine) * (1 - head);
    const float dot = flank * (1 - glm::smoothstep(0.26f, 0.35f, spot.nearest + 0.04f * hair)) * (unit(hash(spot.id, 4)) < 0.92f ? 1.0f : 0.0f);
    s.color = glm::mix(s.color, glm::vec3(0.86f, 0.78f, 0.64f), 0.92f * dot);
    const float rump =
        glm::smoothstep(-0.685f, -0.72f, p.x + 0.015f * hair) * glm::smoothstep(0.70f, 0.78f, p.y) * glm::smoothstep(0.16f, 0.10f, std::abs(p.z));
    s.color = glm::mix(s.color, glm::vec3(0.88f, 0.83f, 0.72f), rump);
    s.color = glm::mix(s.color, glm::vec3(0.045f, 0.03f, 0.022f), rump * glm::smoothstep(0.05f, 0.025f, std::abs(p.z)) * glm::smoothstep(0.90f, 0.98f, p.y));

    // The face: pale throat and ring around the eye, dark bridge.
    const float face = head * glm::smoothstep(0.74f, 0.84f, q.x), throat = head * glm::smoothstep(-0.1f, -0.6f, n.y);
    s.color = glm::mix(s.color, glm::vec3(0.62f, 0.50f, 0.36f), 0.85f * throat);
    s.color =
        glm::mix(s.color, glm::vec3(0.15f, 0.075f, 0.04f), face * glm::smoothstep(0.030f, 0.012f, std::abs(q.z)) * glm::smoothstep(0.2f, 0.6f, n.y) * 0.8f);
    const float toEye = glm::distance(glm::vec3(q.x, q.y, std::abs(q.z)), eye);
    s.color = glm::mix(s.color, glm::vec3(0.60f, 0.47f, 0.33f), 0.7f * head * glm::smoothstep(0.045f, 0.028f, toEye));
    // Inside the ears.
    const float ear = head * glm::smoothstep(0.085f, 0.115f, std::abs(q.z)) * glm::smoothstep(0.1f, 0.5f, glm::dot(n, glm::vec3(headFrame[0]))) *
                      glm::smoothstep(1.66f, 1.60f, q.y);
    s.color = glm::mix(s.color, glm::vec3(0.70f, 0.56f, 0.47f), 0.85f * ear);
    s.color *= 1 + 0.30f * hair;
    s.roughness = 0.62f + 0.16f * hair - 0.10f * back;
    s.height = 0.0011f * hair;

    cover(s, {0.012f, 0.009f, 0.008f}, 0.08f, head * glm::smoothstep(0.0235f, 0.0205f, toEye));
    cover(s, {0.018f, 0.015f, 0.015f}, 0.28f, head * glm::smoothstep(0.062f, 0.050f, glm::distance(q, nose)));
    cover(s, {0.025f, 0.019f, 0.015f}, 0.34f, glm::smoothstep(0.062f, 0.052f, p.y));
    return s;
}

/// Bone: dark and beaded where it left the skull, pale at the tips.
Surface bone(const glm::vec3& p) {
    const Noise noise{73};
    const glm::vec3 q(glm::inverse(headFrame) * glm::vec4(p, 1));
    const float groove = noise.ridged(q * glm::vec3(48, 13, 48), 3), tip = glm::smoothstep(1.62f, 2.16f, q.y + 0.06f * noise.fractal(q * 9.0f, 3)),
                bead = noise.fractal(q * 90.0f, 2) * glm::smoothstep(1.85f, 1.58f, q.y);
    Surface s;
    s.color = glm::mix(glm::vec3(0.13f, 0.075f, 0.042f), glm::vec3(0.60f, 0.49f, 0.35f), tip) * (0.72f + 0.5f * groove);
    s.roughness = 0.58f - 0.26f * tip;
    s.height = 0.0016f * groove * (1 - 0.7f * tip) + 0.0014f * bead;
    return s;
}

}  // namespace

Model deer(Glb& glb, const std::string& name, int texels) {
    Sculpture clay;
    addTrunk(clay);
    addLegs(clay);
    addHead(clay);
    Mesh mesh = clay.mesh(cell);
    append(mesh, antlers());
    mesh = charted(mesh, texels);
    const auto isBone = [](const glm::vec3& p) {
        const glm::vec3 q(glm::inverse(headFrame) * glm::vec4(p, 1));
        return q.y > 1.60f + 0.35f * std::max(0.70f - q.x, 0.0f) || (q.y > 1.548f && q.x > 0.70f && std::abs(q.z) < 0.1f);
    };
    return figure(glb, name, mesh, texels, [&](const glm::vec3& p, const glm::vec3& n) { return isBone(p) ? bone(p) : coat(p, n); });
}

}  // namespace lodestir::generate
