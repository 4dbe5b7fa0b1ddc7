// SPDX-License-Identifier: MIT
// Trees and flowers: see tree.h.
#include "tree.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "random.h"
#include "shapes.h"
#include "spline.h"

namespace lodestir::generate {

namespace {

constexpr float tau = 6.2831853f;

/// A petal-shaped quad from a root along a direction.
void addDab(Mesh& mesh, const glm::vec3& root, const glm::vec3& along, const glm::vec3& side, const glm::vec3& normal, const glm::vec3& color) {
    const uint32_t a = mesh.add({.position = root, .normal = normal, .uv = {0.5f, 1}, .color = color * 0.85f});
    const uint32_t b = mesh.add({.position = root + 0.55f * along + side, .normal = normal, .uv = {1, 0.5f}, .color = color});
    const uint32_t c = mesh.add({.position = root + along, .normal = normal, .uv = {0.5f, 0}, .color = color * 1.1f});
    const uint32_t d = mesh.add({.position = root + 0.5f * along - side, .normal = normal, .uv = {0, 0.5f}, .color = color});
    const glm::vec3 face = glm::cross(side, along);
    if (glm::dot(face, normal) < 0)
        mesh.quad(d, c, b, a);
    else
        mesh.quad(a, b, c, d);
}

}  // namespace

Mesh tree(uint32_t seed, const TreeForm& form) {
    Random random(seed);
    const float crown = form.height * (1 - form.bare);
    // The outline of the crown over its height: round above the waist, drawn in below.
    const auto girth = [&](float t) {
        const float x = t < form.waist ? (form.waist - t) / form.waist : (t - form.waist) / (1 - form.waist);
        return std::sqrt(std::max(1 - x * x, 0.0f));
    };
    struct Clump {
        glm::vec3 centre;
        float radius;
    };
    std::vector<Clump> clumps;
    for (int i = 0; i < 14; ++i) {
        const float t = random.between(0.10f, 0.92f), a = 2.39996f * float(i) + random.between(-0.4f, 0.4f),
                    out = form.spread * girth(t) * random.between(0.35f, 0.72f);
        clumps.push_back({{out * std::sin(a), form.height * form.bare + crown * t, out * std::cos(a)},
                          form.spread * random.between(0.28f, 0.46f) * (0.55f + 0.45f * girth(t))});
    }

    Mesh wood;
    const float thick = 0.035f * form.height;
    const Station trunk[] = {{{0, -0.1f, 0}, 1.5f * thick},
                             {{0.02f * form.height, 0.12f * form.height, 0}, thick},
                             {{-0.01f * form.height, form.height * (form.bare + 0.1f), 0.01f * form.height}, 0.75f * thick},
                             {{0, form.height * (form.bare + 0.6f * (1 - form.bare)), 0}, 0.2f * thick}};
    append(wood, limb(trunk, 3, 9));
    for (size_t i = 0; i < clumps.size(); i += 2) {
        const glm::vec3 to = clumps[i].centre, from(0, glm::mix(form.height * form.bare * 0.9f, to.y, 0.45f), 0);
        const Station bough[] = {{from, 0.45f * thick}, {glm::mix(from, to, 0.5f) + glm::vec3(0, 0.03f * form.height, 0), 0.28f * thick}, {to, 0.1f * thick}};
        append(wood, limb(bough, 3, 6));
    }
    for (Vertex& v : wood.vertices) v.color = glm::vec3(0.115f, 0.078f, 0.058f) * (1 + 0.5f * (unit(hash(seed, uint32_t(v.position.y * 40))) - 0.5f));
    wood.hasColors = true;

    Mesh dabs;
    for (int i = 0; i < form.dabs; ++i) {
        const Clump& clump = clumps[size_t(random.below(int(clumps.size())))];
        const glm::vec3 out = glm::normalize(glm::vec3(random.bell(), random.bell() + 0.25f, random.bell()));
        const float depth = std::sqrt(random.between(0.25f, 1.2f));
        const glm::vec3 root = clump.centre + out * clump.radius * depth;
        const glm::vec3 along = glm::normalize(out + glm::vec3(random.bell(), random.bell() - 0.2f, random.bell()));
        const glm::vec3 side = glm::normalize(glm::cross(along, glm::vec3(random.bell(), random.bell(), random.bell()) + 0.01f));
        const float length = form.dab * random.between(0.6f, 1.3f);
        // Paint is lit as the crown is, not dab by dab; pigment is dark within and below, fresh outside and above.
        const float fresh = glm::clamp(0.75f * (depth - 0.4f) + 0.35f * out.y + random.between(-0.2f, 0.25f), 0.0f, 1.0f);
        glm::vec3 color = glm::mix(form.shade, form.light, fresh);
        if (depth > 0.9f && random.next() < 0.22f) color = form.accent;
        const glm::vec3 middle(0, form.height * form.bare + crown * form.waist, 0);
        const glm::vec3 normal = glm::normalize(out + 0.8f * glm::normalize(root - middle) +
                                                0.4f * glm::cross(side, along) * (glm::dot(glm::cross(side, along), out) < 0 ? -1.0f : 1.0f));
        addDab(dabs, root, along * length, side * (0.36f * length), normal, color * random.between(0.85f, 1.15f));
    }
    dabs.hasColors = true;
    append(wood, dabs);
    return wood;
}

TreeForm cherry(float height, float spread, int dabs, float dab) {
    return {.height = height,
            .spread = spread,
            .waist = 0.5f,
            .bare = 0.32f,
            .dabs = dabs,
            .dab = dab,
            .shade = {0.42f, 0.16f, 0.20f},
            .light = {0.86f, 0.56f, 0.58f},
            .accent = {0.90f, 0.80f, 0.76f}};
}

Material dabs() { return {.name = "dabs", .ior = 1, .doubleSided = true}; }

Mesh flowerPatch(const Flower& flower, int count, float radius) {
    Random random(flower.seed);
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const float r = radius * std::sqrt(random.next()), a = random.between(0, tau), height = random.between(0.14f, 0.42f);
        const glm::vec3 foot(r * std::sin(a), -0.02f, r * std::cos(a));
        const glm::vec3 head = foot + glm::vec3(random.between(-0.07f, 0.07f), height, random.between(-0.07f, 0.07f));
        const glm::vec3 up = glm::normalize(glm::vec3(random.bell() * 0.35f, 1, random.bell() * 0.35f + 0.25f));
        const glm::vec3 right = glm::normalize(glm::cross(up, glm::vec3(0, 0, 1))), ahead = glm::cross(right, up);
        const float turn = random.between(0, tau);
        addDab(mesh, foot, head - foot, glm::vec3(std::cos(turn), 0, std::sin(turn)) * 0.006f, {0, 1, 0}, {0.09f, 0.14f, 0.035f});
        for (int leaf = 0; leaf < 2; ++leaf) {
            const float b = turn + 2.5f * float(leaf);
            const glm::vec3 d(std::sin(b), 0.9f, std::cos(b));
            addDab(mesh, foot, d * 0.12f, glm::vec3(std::cos(b), 0, -std::sin(b)) * 0.02f, {0, 1, 0}, {0.10f, 0.17f, 0.045f});
        }
        const float size = random.between(0.028f, 0.052f);
        const glm::vec3 color = (random.next() < 0.7f ? flower.petals : flower.others) * random.between(0.8f, 1.15f);
        for (int k = 0; k < 5; ++k) {
            const float b = turn + tau * float(k) / 5;
            const glm::vec3 out = right * std::cos(b) + ahead * std::sin(b), across = right * -std::sin(b) + ahead * std::cos(b);
            addDab(mesh, head, (out + 0.25f * up) * size, across * (0.42f * size), up, color);
        }
    }
    mesh.hasColors = true;
    return mesh;
}

}  // namespace lodestir::generate
