// SPDX-License-Identifier: MIT
// A rabbit: see rabbit.h. Modelled a metre tall and made smaller at the end.
#include "rabbit.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "atlas.h"
#include "figure.h"
#include "noise.h"
#include "sculpture.h"

namespace lodestir::generate {

namespace {

constexpr float height = 0.45f / 1.13f;  ///< metres for a metre of the model
constexpr int pictureTexels = 1024;

constexpr glm::vec3 eye(0.315f, 0.585f, 0.108f), nose(0.452f, 0.528f, 0);

void addBody(Sculpture& clay) {
    clay.slim = 0.92f, clay.blend = 0.14f;
    const Station trunk[] = {{{-0.24f, 0.25f, 0}, 0.235f}, {{-0.12f, 0.33f, 0}, 0.245f}, {{0.04f, 0.36f, 0}, 0.205f}, {{0.15f, 0.38f, 0}, 0.165f}};
    clay.limb(trunk);
    const Station chest[] = {{{0.08f, 0.27f, 0}, 0.17f}, {{0.16f, 0.33f, 0}, 0.15f}, {{0.20f, 0.47f, 0}, 0.12f}};
    clay.limb(chest);
    clay.slim = 1, clay.blend = 0.03f;
    clay.lump({-0.485f, 0.17f, 0}, glm::mat3(0.085f));
    for (float side : {-1.0f, 1.0f}) {
        const auto at = [&](float x, float y, float z) { return glm::vec3(x, y, side * z); };
        clay.blend = 0.045f;
        clay.lump(at(-0.17f, 0.205f, 0.175f), glm::mat3(glm::vec3(0.19f, 0.055f, 0), glm::vec3(-0.05f, 0.17f, 0), at(0.01f, 0.02f, 0.095f)));  // haunch
        clay.blend = 0.025f;
        const Station foot[] = {{at(-0.22f, 0.055f, 0.20f), 0.055f}, {at(-0.02f, 0.045f, 0.225f), 0.045f}, {at(0.10f, 0.042f, 0.23f), 0.048f}};
        clay.limb(foot);
        clay.blend = 0.05f;
        const Station upper[] = {{at(0.15f, 0.30f, 0.09f), 0.095f}, {at(0.19f, 0.20f, 0.105f), 0.068f}};
        clay.limb(upper);
        clay.blend = 0.02f;
        const Station lower[] = {
            {at(0.19f, 0.20f, 0.105f), 0.068f}, {at(0.225f, 0.08f, 0.095f), 0.044f}, {at(0.25f, 0.042f, 0.095f), 0.043f}, {at(0.31f, 0.038f, 0.098f), 0.040f}};
        clay.limb(lower);
        clay.blend = 0.008f;
        for (float toe : {-0.024f, 0.0f, 0.024f}) {  // clefts between toes
            clay.hollow(at(0.362f, 0.050f, 0.098f + 1.1f * toe), glm::mat3(glm::vec3(0.030f, 0, 0), glm::vec3(0, 0.036f, 0), glm::vec3(0, 0, 0.006f)));
            clay.hollow(at(0.158f, 0.055f, 0.23f + 1.2f * toe), glm::mat3(glm::vec3(0.036f, 0, 0), glm::vec3(0, 0.042f, 0), glm::vec3(0, 0, 0.006f)));
        }
    }
}

void addHead(Sculpture& clay) {
    clay.blend = 0.06f;
    const Station skull[] = {{{0.20f, 0.56f, 0}, 0.135f}, {{0.29f, 0.575f, 0}, 0.120f}, {{0.375f, 0.535f, 0}, 0.078f}};
    clay.limb(skull);
    for (float side : {-1.0f, 1.0f}) {
        const auto at = [&](float x, float y, float z) { return glm::vec3(x, y, side * z); };
        clay.blend = 0.05f;
        clay.lump(at(0.28f, 0.505f, 0.070f), glm::mat3(0.070f));   // cheek
        clay.lump(at(0.395f, 0.497f, 0.030f), glm::mat3(0.045f));  // whisker pad
        clay.blend = 0.018f;
        clay.lump(at(0.305f, 0.618f, 0.098f), glm::mat3(glm::vec3(0.040f, -0.010f, 0), glm::vec3(0.004f, 0.016f, 0), glm::vec3(0, 0, 0.020f)));  // brow
        clay.hollow(eye * glm::vec3(1, 1, side) + at(0.004f, 0, 0.022f), glm::mat3(0.030f));
        clay.blend = 0.003f;
        clay.lump(eye * glm::vec3(1, 1, side), glm::mat3(0.026f));

        // Ears: spoons with the hollow to the front; the left turned outwards and laid back.
        const float tip = side > 0 ? 0.45f : 0.05f;
        const glm::vec3 along = glm::normalize(at(-0.40f - tip, 1, 0.20f + 0.5f * tip)), front = glm::normalize(at(0.85f, 0.2f, 0.35f + 0.9f * tip));
        const glm::vec3 across = glm::normalize(glm::cross(along, front)), out = glm::cross(across, along);
        const glm::vec3 middle = at(0.165f, 0.66f, 0.062f) + 0.235f * along;
        clay.blend = 0.05f;
        clay.lump(middle, glm::mat3(0.250f * along, 0.068f * across, 0.036f * out));
        clay.blend = 0.022f;
        clay.hollow(middle + 0.040f * out + 0.005f * along, glm::mat3(0.215f * along, 0.046f * across, 0.044f * out));
    }
    clay.blend = 0.010f;
    clay.lump(nose, glm::mat3(glm::vec3(0.016f, 0, 0), glm::vec3(0, 0.014f, 0), glm::vec3(0, 0, 0.022f)));
    clay.hollow({0.452f, 0.490f, 0}, glm::mat3(glm::vec3(0.03f, 0, 0), glm::vec3(0, 0.024f, 0), glm::vec3(0, 0, 0.004f)));  // split lip
}

/// Hair by the lump: tufts that lie backwards, finer than a hand's breadth.
float fur(const glm::vec3& p) {
    const Noise noise{81};
    const glm::vec3 swept = p + 0.03f * noise.at(p * 9.0f);
    return noise.fractal(swept * glm::vec3(17, 30, 38), 3, 0.55f);
}

Surface coat(const glm::vec3& p, const glm::vec3& n) {
    const Noise noise{82};
    const float tuft = fur(p), hair = noise.fractal(p * glm::vec3(70, 160, 190) + tuft, 2, 0.7f), cloud = noise.fractal(p * 3.0f, 3);
    const float toEye = glm::distance(glm::vec3(p.x, p.y, std::abs(p.z)), eye), toNose = glm::distance(p, nose);
    Surface s;
    s.color = glm::mix(glm::vec3(0.50f, 0.41f, 0.32f), glm::vec3(0.33f, 0.25f, 0.185f), glm::smoothstep(0.10f, 0.55f, p.y + 0.12f * cloud - 0.15f * p.x));
    const float below = glm::smoothstep(-0.2f, -0.8f, n.y) * glm::smoothstep(0.48f, 0.36f, p.y), tail = glm::smoothstep(-0.44f, -0.49f, p.x);
    s.color = glm::mix(s.color, glm::vec3(0.74f, 0.70f, 0.63f), std::max(0.7f * below, tail));
    const float ear = glm::smoothstep(0.72f, 0.80f, p.y) * glm::smoothstep(0.25f, 0.75f, n.x);
    s.color = glm::mix(s.color, glm::vec3(0.62f, 0.39f, 0.33f), 0.8f * ear);
    s.color = glm::mix(s.color, glm::vec3(0.16f, 0.115f, 0.09f), 0.75f * glm::smoothstep(1.00f, 1.10f, p.y));
    s.color = glm::mix(s.color, glm::vec3(0.66f, 0.57f, 0.47f), 0.7f * glm::smoothstep(0.060f, 0.038f, toEye));
    s.color *= 1 + 0.16f * tuft + 0.20f * hair;
    s.roughness = 0.72f + 0.10f * hair;
    s.height = height * (0.0022f * hair + 0.0012f * tuft);
    cover(s, {0.018f, 0.010f, 0.007f}, 0.07f, glm::smoothstep(0.0300f, 0.0275f, toEye));
    cover(s, {0.34f, 0.17f, 0.15f}, 0.38f, glm::smoothstep(0.032f, 0.022f, toNose));
    return s;
}

}  // namespace

Model rabbit(Glb& glb, const std::string& name, float cell) {
    Sculpture clay;
    addBody(clay);
    addHead(clay);
    // Tufts stand up from the body, not from eyes and nose.
    clay.relief = [](const glm::vec3& p) {
        const float bald = glm::distance(glm::vec3(p.x, p.y, std::abs(p.z)), eye), tip = glm::distance(p, nose);
        return 0.0034f * fur(p) * glm::smoothstep(0.026f, 0.060f, std::min(bald, tip));
    };
    const Mesh mesh = charted(placed(clay.mesh(cell / height), glm::scale(glm::mat4(1), glm::vec3(height))), pictureTexels);
    return figure(glb, name, mesh, pictureTexels, [](const glm::vec3& p, const glm::vec3& n) { return coat(p / height, n); });
}

}  // namespace lodestir::generate
