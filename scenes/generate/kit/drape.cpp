// SPDX-License-Identifier: MIT
// Draped cloth: see drape.h. Position based dynamics (M. Müller et al., "Position Based Dynamics", 2007), Gauss-Seidel.
#include "drape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "noise.h"
#include "shapes.h"

namespace lodestir::generate {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

class Cloth {
public:
    explicit Cloth(const Drape& d) : drape(d), count(d.particles), spacing(d.size / float(count - 1)) {
        const Noise noise{17, {}};
        const float c = std::cos(d.turn), s = std::sin(d.turn);
        for (int y = 0; y < count; ++y)
            for (int x = 0; x < count; ++x) {
                const glm::vec2 p = (glm::vec2(x, y) / float(count - 1) - 0.5f) * d.size;
                // Uneven from the start, or it would never know to which side it should fold.
                places.push_back(d.centre + glm::vec3(c * p.x + s * p.y, 0.03f * noise.fractal({p.x * 3, 0.5f, p.y * 3}, 3), c * p.y - s * p.x));
            }
        before = places;
        for (int step = 0; step < d.steps; ++step) advance();
    }

    /// A smooth surface through the particles (Catmull-Rom).
    glm::vec3 at(const glm::vec2& uv) const {
        const glm::vec2 p = glm::clamp(uv, 0.0f, 1.0f) * float(count - 1);
        const glm::ivec2 c = glm::min(glm::ivec2(p), glm::ivec2(count - 2));
        const glm::vec2 t = p - glm::vec2(c);
        const auto weights = [](float s) {
            return glm::vec4(-0.5f * s + s * s - 0.5f * s * s * s, 1 - 2.5f * s * s + 1.5f * s * s * s, 0.5f * s + 2 * s * s - 1.5f * s * s * s,
                             0.5f * (s * s * s - s * s));
        };
        const glm::vec4 wx = weights(t.x), wy = weights(t.y);
        glm::vec3 sum(0);
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) sum += wx[x] * wy[y] * particle(c.x + x - 1, c.y + y - 1);
        return sum;
    }

private:
    /// Beyond the hem the cloth goes on straight.
    glm::vec3 particle(int x, int y) const {
        const int cx = std::clamp(x, 0, count - 1), cy = std::clamp(y, 0, count - 1);
        const glm::vec3 p = places[size_t(cy * count + cx)];
        if (x == cx && y == cy) return p;
        return 2.0f * p - places[size_t(std::clamp(2 * cy - y, 0, count - 1) * count + std::clamp(2 * cx - x, 0, count - 1))];
    }

    void advance() {
        constexpr float second = 1.0f / 60, damping = 0.985f, fall = 9.81f * second * second;
        constexpr float fastest = 0.012f;  // of a step: air holds the cloth up, and it never falls through what is thin
        constexpr int rounds = 12;
        for (size_t i = 0; i < places.size(); ++i) {
            const glm::vec3 p = places[i], move = (p - before[i]) * damping - glm::vec3(0, fall, 0);
            places[i] += move * std::min(1.0f, fastest / std::max(glm::length(move), 1e-6f));
            before[i] = p;
        }
        const float diagonal = glm::length(spacing);
        for (int round = 0; round < rounds; ++round) {
            for (int y = 0; y < count; ++y)
                for (int x = 0; x < count; ++x) {
                    hold(x, y, 1, 0, spacing.x, 0.5f), hold(x, y, 0, 1, spacing.y, 0.5f);              // threads do not stretch
                    hold(x, y, 1, 1, diagonal, 0.12f), hold(x, y, -1, 1, diagonal, 0.12f);             // and shear a little
                    hold(x, y, 3, 0, 3 * spacing.x, 0.020f), hold(x, y, 0, 3, 3 * spacing.y, 0.020f);  // a thick cloth resists folding
                }
            if (round % 4 == 3) collide();
        }
    }

    void hold(int x, int y, int dx, int dy, float rest, float stiffness) {
        if (x + dx < 0 || x + dx >= count || y + dy >= count) return;
        glm::vec3 &a = places[size_t(y * count + x)], &b = places[size_t((y + dy) * count + x + dx)];
        const glm::vec3 d = b - a;
        const float length = glm::length(d);
        const glm::vec3 move = d * (stiffness * (length - rest) / std::max(length, 1e-6f));
        a += move, b -= move;
    }

    void collide() {
        constexpr float thickness = 0.008f, grip = 0.9f, e = 0.002f;
        for (size_t i = 0; i < places.size(); ++i) {
            glm::vec3& p = places[i];
            const float depth = thickness - drape.obstacle(p);
            if (depth <= 0) continue;
            glm::vec3 n(0);
            for (const glm::vec3& corner : {glm::vec3(1, -1, -1), glm::vec3(-1, -1, 1), glm::vec3(-1, 1, -1), glm::vec3(1, 1, 1)})
                n += corner * drape.obstacle(p + e * corner);
            n = glm::dot(n, n) > 0 ? glm::normalize(n) : glm::vec3(0, 1, 0);
            p += depth * n;
            const glm::vec3 moved = p - before[i];
            p -= grip * (moved - n * glm::dot(moved, n));
        }
    }

    const Drape& drape;
    int count;
    glm::vec2 spacing;
    std::vector<glm::vec3> places, before;
};

}  // namespace

Mesh draped(const Drape& drape, int cells, const std::function<float(const glm::vec2& uv)>& relief) {
    const Cloth cloth(drape);
    return grid(cells, cells, [&](float u, float v) {
        constexpr float e = 0.002f;
        const glm::vec2 uv(u, v);
        const glm::vec3 right = cloth.at(uv + glm::vec2(e, 0)) - cloth.at(uv - glm::vec2(e, 0)),
                        down = cloth.at(uv + glm::vec2(0, e)) - cloth.at(uv - glm::vec2(0, e));
        return cloth.at(uv) + relief(uv) * glm::normalize(glm::cross(down, right));
    });
}

float damask(const glm::vec2& metres) {
    // Half-drop repeat: two ogees in a cell, one in its middle and one at its corners.
    const glm::vec2 p = metres / damaskSize;
    float raised = 0;
    for (const glm::vec2& shift : {glm::vec2(0), glm::vec2(0.5f)}) {
        const glm::vec2 f = p + shift, q = (f - glm::floor(f) - 0.5f) * glm::vec2(1, 1.5f);  // in widths of the cell
        const auto edge = [](float inside) { return glm::smoothstep(-0.012f, 0.02f, inside); };
        // The ogee: two stems that swell and meet.
        const float stem = 0.235f + 0.235f * std::cos(2 * pi * q.y / 1.5f);
        raised = std::max(raised, edge(0.022f + 0.012f * std::cos(8 * pi * q.y) - std::abs(std::abs(q.x) - stem)));
        // A palmette: leaves that fan out from its foot, a heart, buds beside it.
        const glm::vec2 c(q.x, q.y - 0.16f);  // v runs down: its foot is below
        const float a = std::atan2(c.x, -c.y), r = glm::length(c);
        if (std::abs(a) < 2.3f) {
            const float reach = (0.30f - 0.055f * a * a) * (0.62f + 0.38f * std::abs(std::cos(3.5f * a)));
            const float rib = 0.012f - r * std::abs(std::sin(a - std::round(a * 3.5f / pi) * pi / 3.5f));
            raised = std::max(raised, edge(reach - r) * edge(r - 0.055f) * (1 - 0.75f * edge(rib) * edge(reach - 0.04f - r)));
        }
        raised = std::max(raised, edge(0.040f - r));
        for (float side : {-1.0f, 1.0f}) raised = std::max(raised, edge(0.034f - glm::length((q - glm::vec2(side * 0.105f, 0.27f)) * glm::vec2(1, 0.7f))));
    }
    return raised;
}

Textures paintDamask(const glm::vec2& metres, const glm::vec3& ground, const glm::vec3& figure, uint32_t seed, int width) {
    const Noise noise{seed, {}};
    return paint({.width = width, .height = int(float(width) * metres.y / metres.x), .metres = metres, .repeats = false}, [&](const glm::vec2& p) {
        const float raised = damask(p), rib = std::sin(p.y * 2 * pi / 0.0052f), slub = noise.fractal({p.x * 14, p.y * 320, 0.5f}, 2),
                    wear = noise.fractal(glm::vec3(p * 5.0f, 1.5f), 4);
        const glm::vec2 inset = metres * 0.5f - glm::abs(p - metres * 0.5f);
        const float hem = std::min(inset.x, inset.y), braid = glm::smoothstep(0.020f, 0.023f, hem) * glm::smoothstep(0.052f, 0.049f, hem);
        Surface s;
        s.color = glm::mix(ground, figure, std::max(raised, braid)) * (1 + 0.10f * wear + 0.10f * slub + 0.10f * (1 - raised) * rib);
        s.roughness = glm::mix(0.85f, 0.42f, raised) + 0.05f * slub;
        s.height = 0.00025f * (1 - raised) * rib + 0.0001f * slub;
        return s;
    });
}

}  // namespace lodestir::generate
