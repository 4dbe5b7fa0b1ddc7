// SPDX-License-Identifier: MIT
// A carved horse: see horse.h.
#include "horse.h"

#include <cmath>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "shapes.h"
#include "spline.h"

namespace lodestir::generate {

namespace {

const Station trunk[] = {{{-0.60f, 0.03f, 0}, 0.05f},  {{-0.56f, 0.02f, 0}, 0.13f},  {{-0.46f, 0.02f, 0}, 0.205f},
                         {{-0.30f, 0.01f, 0}, 0.225f}, {{-0.06f, -0.03f, 0}, 0.20f}, {{0.14f, -0.03f, 0}, 0.21f},
                         {{0.30f, 0.02f, 0}, 0.215f},  {{0.42f, 0.07f, 0}, 0.165f},  {{0.49f, 0.09f, 0}, 0.07f}};

/// A horse is narrower than it is tall.
Mesh slim(Mesh mesh, float width) { return placed(std::move(mesh), glm::scale(glm::mat4(1), glm::vec3(1, 1, width))); }

/// A part of the trunk's own tube, `over` metres above it.
Mesh girth(float from, float to, float over) {
    std::vector<Station> band;
    const std::vector<Station> body = spline(trunk, 12);
    for (const Station& s : body)
        if (s.position.x >= from && s.position.x <= to) band.push_back({s.position, s.radius + over});
    return slim(tube(band, 28), 0.86f);
}

void addLegs(Model& model, const HorsePaints& paints) {
    const auto leg = [&](float side, const std::vector<Station>& bones) {
        std::vector<Station> shifted;
        for (const Station& s : bones) shifted.push_back({s.position + glm::vec3(0, 0, side), s.radius});
        model.add(paints.coat, limb(shifted, 4, 12));
        const Station& ankle = shifted[shifted.size() - 1];
        const glm::vec3 along = glm::normalize(ankle.position - shifted[shifted.size() - 2].position);
        const Station hoof[] = {{ankle.position - 0.01f * along, 0.040f}, {ankle.position + 0.03f * along, 0.052f}, {ankle.position + 0.085f * along, 0.060f}};
        model.add(paints.hoof, tube(hoof, 12));
    };
    leg(0.105f,
        {{{0.32f, 0.00f, 0}, 0.12f}, {{0.40f, -0.16f, 0}, 0.085f}, {{0.56f, -0.25f, 0}, 0.058f}, {{0.55f, -0.38f, 0}, 0.038f}, {{0.47f, -0.50f, 0}, 0.040f}});
    leg(-0.105f,
        {{{0.32f, 0.00f, 0}, 0.12f}, {{0.42f, -0.18f, 0}, 0.085f}, {{0.52f, -0.36f, 0}, 0.055f}, {{0.60f, -0.50f, 0}, 0.037f}, {{0.66f, -0.60f, 0}, 0.040f}});
    leg(0.11f, {{{-0.42f, 0.02f, 0}, 0.16f},
                {{-0.40f, -0.18f, 0}, 0.115f},
                {{-0.40f, -0.34f, 0}, 0.068f},
                {{-0.56f, -0.48f, 0}, 0.045f},
                {{-0.66f, -0.64f, 0}, 0.040f}});
    leg(-0.11f, {{{-0.42f, 0.02f, 0}, 0.16f},
                 {{-0.34f, -0.18f, 0}, 0.115f},
                 {{-0.27f, -0.34f, 0}, 0.068f},
                 {{-0.38f, -0.50f, 0}, 0.045f},
                 {{-0.44f, -0.66f, 0}, 0.040f}});
}

void addHead(Model& model, const HorsePaints& paints) {
    const Station neck[] = {{{0.26f, 0.04f, 0}, 0.20f},  {{0.38f, 0.20f, 0}, 0.165f}, {{0.49f, 0.38f, 0}, 0.120f},
                            {{0.56f, 0.53f, 0}, 0.095f}, {{0.61f, 0.62f, 0}, 0.075f}, {{0.66f, 0.66f, 0}, 0.03f}};
    model.add(paints.coat, slim(limb(neck, 5, 18), 0.72f));
    const Station skull[] = {{{0.54f, 0.61f, 0}, 0.05f},  {{0.58f, 0.60f, 0}, 0.088f}, {{0.66f, 0.56f, 0}, 0.100f}, {{0.76f, 0.46f, 0}, 0.074f},
                             {{0.84f, 0.37f, 0}, 0.060f}, {{0.89f, 0.32f, 0}, 0.058f}, {{0.92f, 0.29f, 0}, 0.035f}};
    model.add(paints.coat, slim(limb(skull, 5, 16), 0.74f));
    for (float side : {-1.0f, 1.0f}) {
        const Station ear[] = {{{0.59f, 0.66f, side * 0.04f}, 0.020f}, {{0.59f, 0.72f, side * 0.05f}, 0.024f}, {{0.61f, 0.79f, side * 0.05f}, 0.004f}};
        model.add(paints.coat, limb(ear, 3, 8));
        Mesh eye = bent(sphere(10, 6), [&](const glm::vec3& p) { return 0.017f * p + glm::vec3(0.69f, 0.575f, side * 0.062f); });
        model.add(paints.eye, eye);
    }
    // Headstall: rings around muzzle and brow, and a rosette.
    const auto ring = [&](const glm::vec3& at, const glm::vec3& along, float radius) {
        const glm::vec3 d = glm::normalize(along) * 0.009f;
        const Station band[] = {{at - d, radius}, {at + d, radius}};
        model.add(paints.saddle, slim(tube(band, 16), 0.76f));
    };
    ring({0.80f, 0.42f, 0}, {1, -1, 0}, 0.073f);
    ring({0.63f, 0.58f, 0}, {1, -0.5f, 0}, 0.106f);
}

/// Locks of hair from the crest of the neck, swept back, in two layers a side.
void addHair(Model& model, const HorsePaints& paints) {
    for (int i = 0; i < 9; ++i) {
        const float t = float(i) / 8;
        const glm::vec3 root =
            glm::mix(glm::vec3(0.60f, 0.70f, 0), glm::vec3(0.20f, 0.24f, 0), t) + glm::vec3(-0.02f * std::sin(3.1f * t), 0.04f * std::sin(3.1f * t), 0);
        for (float side : {-1.0f, 1.0f}) {
            const float wave = (i % 2 ? 0.03f : -0.01f);
            const Station lock[] = {{root, 0.03f},
                                    {root + glm::vec3(-0.08f, 0.015f, side * 0.05f), 0.034f},
                                    {root + glm::vec3(-0.13f, -0.07f + wave, side * 0.10f), 0.026f},
                                    {root + glm::vec3(-0.20f, -0.12f + wave, side * 0.115f), 0.005f}};
            model.add(paints.mane, limb(lock, 3, 7));
        }
    }
    const Station forelock[] = {{{0.59f, 0.69f, 0}, 0.025f}, {{0.66f, 0.68f, 0}, 0.028f}, {{0.72f, 0.60f, 0}, 0.006f}};
    model.add(paints.mane, limb(forelock, 3, 7));
    for (float side : {-0.035f, 0.0f, 0.035f}) {
        const Station tail[] = {{{-0.55f, 0.10f, 0}, 0.035f},
                                {{-0.66f, 0.15f, side}, 0.055f},
                                {{-0.78f, 0.02f, 1.6f * side}, 0.065f},
                                {{-0.82f, -0.20f + side, 2 * side}, 0.052f},
                                {{-0.90f + side, -0.40f, 1.5f * side}, 0.008f}};
        model.add(paints.mane, limb(tail, 4, 9));
    }
}

void addHarness(Model& model, const HorsePaints& paints) {
    model.add(paints.cloth, girth(-0.34f, 0.16f, 0.012f));
    model.add(paints.gilt, girth(-0.365f, -0.335f, 0.017f));
    model.add(paints.gilt, girth(0.155f, 0.185f, 0.017f));
    model.add(paints.saddle, girth(-0.08f, -0.03f, 0.018f));
    // The seat: a shell that rises to pommel and cantle, drawn down at the flanks.
    Mesh seat = bent(roundedBox({0.40f, 0.07f, 0.30f}, 0.033f, 3, Axis::x, 8), [](const glm::vec3& p) {
        const float x = p.x / 0.2f, z = p.z / 0.15f;
        return glm::vec3(p.x - 0.09f, p.y + 0.185f + 0.065f * x * x - 0.09f * z * z, p.z * 0.95f);
    });
    model.add(paints.saddle, seat);
    const Station breast[] = {{{0.12f, -0.05f, 0.19f}, 0.014f}, {{0.36f, 0.0f, 0.175f}, 0.014f},  {{0.50f, 0.03f, 0.06f}, 0.014f},
                              {{0.50f, 0.03f, -0.06f}, 0.014f}, {{0.36f, 0.0f, -0.175f}, 0.014f}, {{0.12f, -0.05f, -0.19f}, 0.014f}};
    model.add(paints.gilt, limb(breast, 4, 6));
    for (float side : {-1.0f, 1.0f}) {
        const Station strap[] = {{{-0.06f, 0.05f, side * 0.19f}, 0.010f}, {{-0.05f, -0.25f, side * 0.205f}, 0.010f}};
        model.add(paints.saddle, tube(strap, 6));
        Mesh stirrup = bent(sphere(10, 6), [&](const glm::vec3& p) { return glm::vec3(-0.05f, -0.27f, side * 0.205f) + p * glm::vec3(0.05f, 0.04f, 0.02f); });
        model.add(paints.gilt, stirrup);
    }
}

}  // namespace

Model horse(const std::string& name, const HorsePaints& paints) {
    Model model{name, {}};
    model.add(paints.coat, slim(limb(trunk, 5, 24), 0.86f));
    addLegs(model, paints);
    addHead(model, paints);
    addHair(model, paints);
    addHarness(model, paints);
    return model;
}

}  // namespace lodestir::generate
