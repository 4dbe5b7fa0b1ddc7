// SPDX-License-Identifier: MIT
// A bronze cat: see cat.h. After those of Bastet: long legs, small head, large ears.
#include "cat.h"

#include <algorithm>
#include <cmath>

#include "atlas.h"
#include "figure.h"
#include "noise.h"
#include "sculpture.h"

namespace lodestir::generate {

namespace {

constexpr int pictureTexels = 1024;

constexpr glm::vec3 eye(0.196f, 0.838f, 0.052f), nose(0.258f, 0.790f, 0);

/// The neck's axis, which collars lie around.
constexpr glm::vec3 neckFoot(0.075f, 0.60f, 0), neckHead(0.115f, 0.76f, 0);

void addBody(Sculpture& clay) {
    clay.slim = 0.86f, clay.blend = 0.11f;
    const Station trunk[] = {{{-0.15f, 0.19f, 0}, 0.185f}, {{-0.09f, 0.32f, 0}, 0.170f}, {{0.0f, 0.46f, 0}, 0.148f}, {{0.055f, 0.575f, 0}, 0.118f}};
    clay.limb(trunk);
    const Station neck[] = {{{0.05f, 0.56f, 0}, 0.112f}, {neckFoot, 0.092f}, {neckHead, 0.074f}};
    clay.limb(neck);
    clay.slim = 1, clay.blend = 0.05f;
    const Station chest[] = {{{0.075f, 0.40f, 0}, 0.085f}, {{0.115f, 0.52f, 0}, 0.075f}};
    clay.limb(chest);
    for (float side : {-1.0f, 1.0f}) {
        const auto at = [&](float x, float y, float z) { return glm::vec3(x, y, side * z); };
        clay.blend = 0.05f;
        clay.lump(at(-0.08f, 0.185f, 0.125f), glm::mat3(glm::vec3(0.165f, 0.06f, 0), glm::vec3(-0.05f, 0.15f, 0), at(0.01f, 0.01f, 0.075f)));  // haunch
        clay.lump(at(0.06f, 0.50f, 0.075f), glm::mat3(glm::vec3(0.055f, 0.02f, 0), glm::vec3(-0.02f, 0.12f, 0), at(0, 0, 0.055f)));            // shoulder
        clay.blend = 0.025f;
        const Station hind[] = {{at(-0.10f, 0.05f, 0.150f), 0.045f}, {at(0.04f, 0.040f, 0.160f), 0.038f}, {at(0.115f, 0.036f, 0.160f), 0.040f}};
        clay.limb(hind);
        clay.blend = 0.04f;
        const Station fore[] = {{at(0.095f, 0.47f, 0.070f), 0.064f},
                                {at(0.135f, 0.30f, 0.062f), 0.050f},
                                {at(0.155f, 0.14f, 0.060f), 0.040f},
                                {at(0.165f, 0.045f, 0.062f), 0.041f}};
        clay.limb(fore);
        clay.blend = 0.015f;
        clay.lump(at(0.200f, 0.034f, 0.064f), glm::mat3(glm::vec3(0.062f, 0, 0), glm::vec3(0, 0.036f, 0), glm::vec3(0, 0, 0.044f)));
        clay.blend = 0.008f;
        for (float toe : {-0.020f, 0.0f, 0.020f}) {  // clefts between toes
            clay.hollow(at(0.252f, 0.040f, 0.064f + toe), glm::mat3(glm::vec3(0.026f, 0, 0), glm::vec3(0, 0.030f, 0), glm::vec3(0, 0, 0.0045f)));
            clay.hollow(at(0.150f, 0.042f, 0.160f + toe), glm::mat3(glm::vec3(0.026f, 0, 0), glm::vec3(0, 0.032f, 0), glm::vec3(0, 0, 0.0045f)));
        }
    }
    clay.blend = 0.02f;
    const Station tail[] = {{{-0.25f, 0.12f, 0}, 0.050f},      {{-0.31f, 0.06f, 0.05f}, 0.044f},  {{-0.26f, 0.042f, 0.17f}, 0.040f},
                            {{-0.12f, 0.038f, 0.24f}, 0.037f}, {{0.05f, 0.035f, 0.245f}, 0.034f}, {{0.17f, 0.032f, 0.20f}, 0.030f},
                            {{0.245f, 0.026f, 0.145f}, 0.022f}};
    clay.limb(tail);
}

void addHead(Sculpture& clay) {
    clay.slim = 1, clay.blend = 0.045f;
    clay.lump({0.125f, 0.838f, 0}, glm::mat3(glm::vec3(0.108f, -0.02f, 0), glm::vec3(0.02f, 0.088f, 0), glm::vec3(0, 0, 0.093f)));
    clay.blend = 0.04f;
    const Station muzzle[] = {{{0.17f, 0.812f, 0}, 0.062f}, {{0.222f, 0.790f, 0}, 0.040f}};
    clay.limb(muzzle);
    for (float side : {-1.0f, 1.0f}) {
        const auto at = [&](float x, float y, float z) { return glm::vec3(x, y, side * z); };
        clay.blend = 0.02f;
        clay.lump(at(0.228f, 0.778f, 0.022f), glm::mat3(0.030f));  // whisker pad
        clay.lump(at(0.140f, 0.800f, 0.062f), glm::mat3(0.050f));  // cheek
        const glm::vec3 almond = glm::normalize(at(0.55f, 0.22f, -0.6f)), out = glm::normalize(at(0.8f, 0.15f, 0.58f)), upward = glm::cross(almond, out);
        clay.blend = 0.010f;
        clay.hollow(eye * glm::vec3(1, 1, side) + 0.014f * out, glm::mat3(0.036f * almond, 0.020f * upward, 0.018f * out));
        clay.blend = 0.003f;
        clay.lump(eye * glm::vec3(1, 1, side) - 0.002f * out, glm::mat3(0.025f * almond, 0.014f * upward, 0.013f * out));

        // Ears: tall leaves, a little apart, their hollows to the front.
        const glm::vec3 along = glm::normalize(at(-0.10f, 1, 0.30f)), front = glm::normalize(at(0.90f, 0.05f, 0.42f));
        const glm::vec3 across = glm::normalize(glm::cross(along, front)), face = glm::cross(across, along);
        const glm::vec3 middle = at(0.100f, 0.925f, 0.066f);
        clay.blend = 0.025f;
        clay.lump(middle, glm::mat3(0.086f * along, 0.044f * across, 0.026f * face));
        clay.blend = 0.012f;
        clay.hollow(middle + 0.024f * face + 0.006f * along, glm::mat3(0.070f * along, 0.029f * across, 0.022f * face));
    }
    clay.blend = 0.008f;
    clay.lump(nose, glm::mat3(glm::vec3(0.012f, 0, 0), glm::vec3(0, 0.011f, 0), glm::vec3(0, 0, 0.016f)));
    clay.hollow({0.256f, 0.760f, 0}, glm::mat3(glm::vec3(0.03f, 0, 0), glm::vec3(0, 0.018f, 0), glm::vec3(0, 0, 0.003f)));  // split lip
}

/// Where a place lies along the neck, 0 at its foot and 1 at its head, on the outside of it alone.
float alongNeck(const glm::vec3& p) {
    const glm::vec3 axis = neckHead - neckFoot, q = p - neckFoot;
    const float t = glm::dot(q, axis) / glm::dot(axis, axis);
    return glm::distance(q, t * axis) < 0.19f ? t : -10.0f;
}

/// How much of a place the collar covers: three rows of beads that lie on chest and shoulders.
float collar(const glm::vec3& p) {
    const float t = alongNeck(p);
    return glm::smoothstep(-0.62f, -0.58f, t) * glm::smoothstep(0.42f, 0.38f, t);
}

/// Rounded beads in three rows, [0, 1].
float beads(const glm::vec3& p) {
    const glm::vec3 q = p - neckFoot;
    return collar(p) * std::abs(std::sin(20 * std::atan2(q.z, q.x)) * std::sin(3.1415927f * 3 * (alongNeck(p) + 0.6f)));
}

/// The collar stands out as a whole, and its beads by half: the picture has the other half, or coarse levels would lose them.
float relief(const glm::vec3& p) {
    const float hammered = Noise{91}.fractal(p * 26.0f, 2);
    return 0.0035f * collar(p) + 0.002f * beads(p) + 0.0011f * hammered;
}

Surface bronze(const glm::vec3& p, const glm::vec3& n) {
    const Noise noise{92};
    const float cloud = noise.fractal(p * 5.0f, 4), fine = noise.fractal(p * 42.0f, 3, 0.6f);
    Surface s;
    s.color = glm::mix(glm::vec3(0.30f, 0.185f, 0.095f), glm::vec3(0.52f, 0.345f, 0.18f), glm::smoothstep(-0.4f, 0.5f, cloud + 0.3f * fine));
    s.metalness = 1;
    s.roughness = 0.34f + 0.10f * fine;
    s.height = 0.0005f * fine;
    // Rain ran down from what lies open and stood in hollows.
    const float streak = noise.fractal(p * glm::vec3(22, 2.5f, 22) + 0.4f * cloud, 3), low = glm::smoothstep(0.22f, 0.02f, p.y);
    const float verdigris = glm::smoothstep(0.08f, 0.42f, 0.55f * streak + 0.35f * cloud + 0.28f * low + 0.20f * std::max(n.y, 0.0f) - 0.10f);
    const glm::vec3 green = glm::mix(glm::vec3(0.10f, 0.24f, 0.185f), glm::vec3(0.24f, 0.42f, 0.33f), 0.5f + 0.5f * fine);
    cover(s, green, 0.85f, 0.85f * verdigris);
    const float toEye = glm::distance(glm::vec3(p.x, p.y, std::abs(p.z)), eye);
    const glm::vec3 gold(0.95f, 0.66f, 0.26f);
    const auto gilded = [&](float share) { cover(s, gold * (1 + 0.10f * fine), 0.24f + 0.06f * fine, share, 1); };
    gilded(collar(p));
    s.color *= 1 - 0.6f * collar(p) * glm::smoothstep(0.25f, 0.0f, beads(p));
    s.height += 0.0025f * beads(p);
    gilded(glm::smoothstep(0.027f, 0.024f, toEye));
    cover(s, glm::vec3(0.012f), 0.10f, glm::smoothstep(0.0125f, 0.0105f, toEye));
    return s;
}

}  // namespace

Model cat(Glb& glb, const std::string& name, float cell) {
    Sculpture clay;
    addBody(clay);
    addHead(clay);
    clay.relief = relief;
    return figure(glb, name, charted(clay.mesh(cell), pictureTexels, 300), pictureTexels, bronze);
}

}  // namespace lodestir::generate
