// SPDX-License-Identifier: MIT
// Turned chess pieces: see chess_pieces.h.
#include "chess_pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "shapes.h"

namespace lodestir::generate {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr int columns = 80;

/// A smooth part of a profile, from its top down.
using Curve = std::vector<glm::vec2>;

/// Parts of a profile joined by hard edges.
std::vector<glm::vec2> profileOf(const std::vector<Curve>& parts, int steps) {
    std::vector<glm::vec2> profile;
    for (const Curve& part : parts)
        for (const glm::vec2& p : smoothCurve(part, steps))
            if (profile.empty() || glm::distance(profile.back(), p) > 1e-4f) profile.push_back(p);
    return profile;
}

/// The foot that all pieces share, scaled in width: a bead, a cove and a plinth.
std::vector<Curve> foot(float width) {
    const auto w = [&](float x) { return x * width; };
    return {{{w(0.235f), 0.30f}, {w(0.27f), 0.255f}, {w(0.30f), 0.245f}, {w(0.305f), 0.225f}, {w(0.285f), 0.205f}},
            {{w(0.285f), 0.205f}, {w(0.32f), 0.17f}, {w(0.375f), 0.145f}, {w(0.39f), 0.12f}, {w(0.375f), 0.10f}},
            {{w(0.375f), 0.10f}, {w(0.40f), 0.085f}, {w(0.405f), 0.05f}, {w(0.40f), 0.015f}, {w(0.385f), 0.0f}},
            {{w(0.385f), 0.0f}, {0, 0}}};
}

/// A turned piece: the curves from the top down to the foot, and the foot.
std::vector<glm::vec2> turnedProfile(std::vector<Curve> upper, float footWidth, int steps = 7) {
    for (Curve& part : foot(footWidth)) upper.push_back(std::move(part));
    return profileOf(upper, steps);
}

/// A ball of radius r around (0, y) as a profile, from its top to where it meets the radius `neck` below.
Curve ball(float r, float y, float neck) {
    Curve curve;
    const float end = pi - std::asin(neck / r);
    for (int i = 0; i <= 12; ++i) {
        const float theta = end * float(i) / 12;
        curve.push_back({r * std::sin(theta), y + r * std::cos(theta)});
    }
    return curve;
}

Mesh pawn() {
    return turned(turnedProfile({ball(0.175f, 0.80f, 0.095f),
                                 {{0.095f, 0.655f}, {0.20f, 0.645f}, {0.215f, 0.63f}, {0.20f, 0.612f}, {0.115f, 0.60f}},
                                 {{0.115f, 0.60f}, {0.118f, 0.52f}, {0.145f, 0.42f}, {0.205f, 0.32f}, {0.235f, 0.30f}}},
                                0.86f),
                  columns, 30);
}

Mesh rook() {
    Mesh mesh = turned(
        turnedProfile({{{0, 0.90f}, {0.15f, 0.90f}},
                       {{0.15f, 0.90f}, {0.165f, 0.93f}, {0.165f, 1.0f}, {0.175f, 1.01f}, {0.25f, 1.01f}, {0.262f, 1.0f}, {0.262f, 0.86f}},
                       {{0.262f, 0.86f}, {0.262f, 0.84f}, {0.22f, 0.80f}, {0.20f, 0.78f}},
                       {{0.20f, 0.78f}, {0.235f, 0.765f}, {0.235f, 0.745f}, {0.195f, 0.73f}},
                       {{0.195f, 0.73f}, {0.185f, 0.62f}, {0.20f, 0.45f}, {0.25f, 0.32f}, {0.235f, 0.30f}}},
                      0.98f, 8),
        columns, 30);
    // Six gaps in the parapet; their sides are as steep as two columns of the mesh.
    for (Vertex& v : mesh.vertices) {
        const float a = std::atan2(v.position.x, v.position.z) / (2 * pi) * 6, within = std::abs(a - std::round(a));
        const float gap = 1 - glm::smoothstep(0.13f, 0.18f, within);
        if (v.position.y > 0.915f) v.position.y = glm::mix(v.position.y, 0.915f, gap);
    }
    computeNormals(mesh, 34);
    return mesh;
}

Mesh bishop() {
    Mesh mesh = turned(turnedProfile({ball(0.052f, 1.20f, 0.03f),
                                      {{0.03f, 1.157f}, {0.10f, 1.10f}, {0.158f, 1.0f}, {0.168f, 0.92f}, {0.135f, 0.83f}, {0.10f, 0.80f}},
                                      {{0.10f, 0.80f}, {0.205f, 0.79f}, {0.215f, 0.775f}, {0.20f, 0.757f}, {0.12f, 0.745f}},
                                      {{0.12f, 0.745f}, {0.165f, 0.735f}, {0.165f, 0.72f}, {0.115f, 0.705f}},
                                      {{0.115f, 0.705f}, {0.112f, 0.60f}, {0.14f, 0.45f}, {0.215f, 0.33f}, {0.235f, 0.30f}}},
                                     0.94f, 9),
                       columns, 30);
    // The mitre's slot: a sheet that leans across it.
    const glm::vec3 lean = glm::normalize(glm::vec3(0.62f, 0.78f, 0));
    for (Vertex& v : mesh.vertices) {
        if (v.position.y < 0.85f || v.position.y > 1.14f || v.position.x < 0) continue;
        const float across = glm::dot(v.position - glm::vec3(0.10f, 1.045f, 0), lean);
        const float depth = 1 - glm::smoothstep(0.010f, 0.022f, std::abs(across));
        v.position.x *= 1 - 0.42f * depth * glm::smoothstep(0.0f, 0.06f, v.position.x);
    }
    computeNormals(mesh, 34);
    return mesh;
}

/// The tall stem that queen and king share, below `top`.
std::vector<Curve> stem(float top) {
    return {{{0.12f, top}, {0.235f, top - 0.01f}, {0.25f, top - 0.03f}, {0.23f, top - 0.05f}, {0.14f, top - 0.06f}},
            {{0.14f, top - 0.06f}, {0.185f, top - 0.07f}, {0.185f, top - 0.09f}, {0.13f, top - 0.105f}},
            {{0.13f, top - 0.105f}, {0.125f, top - 0.24f}, {0.155f, 0.48f}, {0.225f, 0.34f}, {0.235f, 0.30f}}};
}

Mesh queen() {
    std::vector<Curve> curves{ball(0.062f, 1.395f, 0.04f),
                              {{0.04f, 1.345f}, {0.10f, 1.325f}, {0.165f, 1.29f}, {0.185f, 1.285f}},
                              {{0.185f, 1.285f}, {0.215f, 1.335f}, {0.232f, 1.34f}, {0.232f, 1.325f}},
                              {{0.232f, 1.325f}, {0.19f, 1.22f}, {0.145f, 1.09f}, {0.125f, 1.0f}, {0.12f, 0.97f}}};
    for (Curve& part : stem(0.97f)) curves.push_back(std::move(part));
    Mesh mesh = turned(turnedProfile(std::move(curves), 1.05f, 8), columns, 30);
    for (Vertex& v : mesh.vertices) {  // eleven points on the coronet
        const float r = glm::length(glm::vec2(v.position.x, v.position.z)), a = std::atan2(v.position.x, v.position.z);
        const float crown = glm::smoothstep(1.19f, 1.33f, v.position.y) * glm::smoothstep(0.17f, 0.21f, r);
        v.position.y -= 0.05f * crown * (0.5f - 0.5f * std::cos(10 * a));
        const float flute = glm::smoothstep(1.0f, 1.1f, v.position.y) * glm::smoothstep(0.10f, 0.14f, r) *
                            (1 - glm::smoothstep(1.24f, 1.30f, v.position.y));
        const float pinch = 1 - 0.05f * flute * (0.5f - 0.5f * std::cos(10 * a));
        v.position.x *= pinch;
        v.position.z *= pinch;
    }
    computeNormals(mesh, 34);
    return mesh;
}

Mesh king() {
    std::vector<Curve> curves{{{0, 1.415f}, {0.05f, 1.41f}, {0.062f, 1.395f}, {0.05f, 1.375f}},
                              {{0.05f, 1.375f}, {0.12f, 1.365f}, {0.19f, 1.33f}, {0.205f, 1.31f}},
                              {{0.205f, 1.31f}, {0.22f, 1.30f}, {0.22f, 1.285f}, {0.205f, 1.275f}},
                              {{0.205f, 1.275f}, {0.17f, 1.16f}, {0.14f, 1.07f}, {0.12f, 1.01f}}};
    for (Curve& part : stem(1.01f)) curves.push_back(std::move(part));
    Mesh mesh = turned(turnedProfile(std::move(curves), 1.08f, 8), columns, 30);
    for (const auto& [size, y] : {std::pair{glm::vec3(0.055f, 0.21f, 0.05f), 1.50f}, std::pair{glm::vec3(0.17f, 0.055f, 0.05f), 1.525f}}) {
        Mesh bar = placed(roundedBox(size, 0.014f, 5, Axis::y, 6), glm::vec3(0, y, 0));
        scaleUv(bar, glm::vec2(0.2f), {0.05f, 0.05f});
        append(mesh, bar);
    }
    return mesh;
}

/// A point of the knight's spine: where it is, and half the depth (within the plane of the profile) and half the width there.
struct Rib {
    glm::vec2 at;
    float depth, width;
};

/// From the chest over the poll to the muzzle.
constexpr Rib spine[] = {{{0.0f, 0.26f}, 0.235f, 0.225f},   {{-0.015f, 0.40f}, 0.215f, 0.175f}, {{-0.055f, 0.56f}, 0.205f, 0.135f},
                         {{-0.07f, 0.72f}, 0.19f, 0.115f},  {{-0.03f, 0.86f}, 0.165f, 0.11f},   {{0.04f, 0.935f}, 0.14f, 0.115f},
                         {{0.11f, 0.925f}, 0.122f, 0.108f}, {{0.18f, 0.865f}, 0.10f, 0.088f},   {{0.24f, 0.80f}, 0.078f, 0.075f},
                         {{0.285f, 0.75f}, 0.066f, 0.070f}, {{0.31f, 0.72f}, 0.045f, 0.050f},   {{0.318f, 0.712f}, 0.0f, 0.0f}};

Rib ribAt(float t) {
    const int count = int(std::size(spine)), i = std::min(int(t * float(count - 1)), count - 2);
    const float x = t * float(count - 1) - float(i);
    const auto at = [&](int k) { return spine[size_t(std::clamp(k, 0, count - 1))]; };
    const auto curve = [&](auto value) {
        const auto a = value(at(i - 1)), b = value(at(i)), c = value(at(i + 1)), d = value(at(i + 2));
        return 0.5f *
               (2.0f * b + (c - a) * x + (2.0f * a - 5.0f * b + 4.0f * c - d) * (x * x) + (3.0f * b - a - 3.0f * c + d) * (x * x * x));
    };
    return {curve([](const Rib& r) { return r.at; }), std::max(curve([](const Rib& r) { return r.depth; }), 0.0f),
            std::max(curve([](const Rib& r) { return r.width; }), 0.0f)};
}

/// Neck and head: an ellipse carried along the spine, narrowed to a crest behind, with a cut mane, sockets and a mouth.
Mesh horse() {
    Mesh mesh = grid(88, 110, [](float u, float v) {
        const Rib rib = ribAt(v), ahead = ribAt(std::min(v + 0.02f, 1.0f)), behind = ribAt(std::max(v - 0.02f, 0.0f));
        const glm::vec2 along = glm::normalize(ahead.at - behind.at), back(-along.y, along.x);  // away from the chest
        const float phi = u == 1 ? 0 : u * 2 * pi, out = std::cos(phi), side = std::sin(phi);
        const float crest = glm::smoothstep(0.2f, 1.0f, out) * (1 - glm::smoothstep(0.50f, 0.62f, v));
        float depth = rib.depth * out * (1 + 0.16f * crest), width = rib.width * side * (1 - 0.55f * crest);
        depth *= 1 + 0.035f * crest * std::sin(v * 95);  // the mane
        const float cheek =
            std::exp(-std::pow((v - 0.53f) / 0.07f, 2.0f)) * glm::smoothstep(-1.0f, -0.2f, out) * glm::smoothstep(0.7f, 0.0f, out);
        width *= 1 + 0.16f * cheek;
        const glm::vec2 eye((v - 0.575f) / 0.028f, (out - 0.42f) / 0.20f);
        width *= 1 - 0.22f * std::exp(-glm::dot(eye, eye));
        const glm::vec2 nostril((v - 0.865f) / 0.018f, (out - 0.35f) / 0.22f);
        width *= 1 - 0.30f * std::exp(-glm::dot(nostril, nostril));
        const float mouth = std::exp(-std::pow((out + 0.42f) / 0.10f, 2.0f)) * glm::smoothstep(0.76f, 0.82f, v);
        width *= 1 - 0.22f * mouth;
        const glm::vec2 p = rib.at + back * depth;
        return glm::vec3(p.x, p.y, rib.depth == 0 ? 0 : width);
    });
    const float below = 0.205f;
    for (Vertex& v : mesh.vertices) v.position.y = std::max(v.position.y, below);  // the chest stands on the foot
    return mesh;
}

Mesh ear(float side) {
    return grid(24, 16, [side](float u, float v) {
        const float phi = (u == 1 ? 0 : u) * 2 * pi,
                    r = 0.042f * std::pow(1 - v, 0.7f) * (1 - 0.35f * glm::smoothstep(0.4f, 1.0f, std::cos(phi)));
        const glm::vec3 axis = glm::normalize(glm::vec3(-0.16f, 1, 0.22f * side));
        return glm::vec3(0.0f, 0.985f, 0.062f * side) + axis * (0.17f * v) + glm::vec3(r * std::cos(phi), 0, 0.8f * r * std::sin(phi));
    });
}

Mesh knight() {
    Mesh mesh = turned(turnedProfile({{{0, 0.315f}, {0.20f, 0.312f}, {0.235f, 0.30f}}}, 1.0f), columns, 30);
    scaleUv(mesh, {1, 0.4f}, {0, 0.6f});
    Mesh head = horse();
    scaleUv(head, {0.8f, 0.58f});
    append(mesh, head);
    for (float side : {-1.0f, 1.0f}) {
        Mesh one = ear(side);
        scaleUv(one, {0.18f, 0.25f}, {0.81f, side < 0 ? 0.0f : 0.27f});
        append(mesh, one);
    }
    computeNormals(mesh, 50);
    return mesh;
}

}  // namespace

Mesh chessPiece(Piece piece) {
    switch (piece) {
    case Piece::pawn: return pawn();
    case Piece::rook: return rook();
    case Piece::knight: return knight();
    case Piece::bishop: return bishop();
    case Piece::queen: return queen();
    case Piece::king: return king();
    }
    return {};
}

}  // namespace lodestir::generate
