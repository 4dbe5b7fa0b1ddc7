// SPDX-License-Identifier: MIT
// Woven things: see cloth.h.
#include "cloth.h"

#include <algorithm>
#include <cmath>

#include "noise.h"
#include "random.h"
#include "shapes.h"

namespace lodestir::generate {

namespace {
constexpr float tau = 6.2831853f;
}

Textures paintWeave(uint32_t seed, int width) {
    constexpr int threads = 48;  // per repeat, 3.3 mm apart
    const Noise slub{seed, {6, threads, 0}};
    const Noise fuzz{seed + 1, {96, 96, 0}};
    return paint({.width = width, .height = width, .metres = glm::vec2(weaveSize)}, [&](const glm::vec2& p) {
        const glm::vec2 q = p / weaveSize * float(threads);
        const glm::vec2 cell = glm::floor(q), f = q - cell;
        // Warp and weft pass over each other in turn; a thread arches where it lies on top.
        const bool warpOnTop = (int(cell.x) + int(cell.y)) % 2 == 0;
        const float along = warpOnTop ? f.y : f.x, across = warpOnTop ? f.x : f.y;
        const float arch = std::sin(along * tau / 2), round = std::sqrt(std::max(1 - std::pow(2 * across - 1, 2.0f), 0.0f));
        const float thread = arch * (0.3f + 0.7f * round);
        const float uneven = warpOnTop ? slub.at({q.y / threads * 6, cell.x, 0.5f}) : slub.at({q.x / threads * 6, cell.y + 0.5f, 3.5f});
        const float hair = fuzz.fractal(glm::vec3(p / weaveSize * 96.0f, 0.5f), 2, 0.7f);
        Surface s;
        s.color = glm::vec3(0.96f) * (0.60f + 0.40f * thread) * (1 + 0.10f * uneven + 0.07f * hair);
        s.roughness = 0.92f;
        s.height = 5.5e-4f * thread * (1 + 0.3f * uneven) + 8e-5f * hair;
        return s;
    });
}

Textures paintRug(uint32_t seed, int width, const glm::vec2& metres) {
    const Noise noise{seed};
    const int height = int(float(width) * metres.y / metres.x);
    const glm::vec3 cream(0.56f, 0.50f, 0.41f), ink(0.055f, 0.06f, 0.075f), rust(0.36f, 0.115f, 0.055f), blue(0.085f, 0.14f, 0.19f);
    return paint({.width = width, .height = height, .metres = metres, .repeats = false}, [&](const glm::vec2& p) {
        // Hand-knotted: lines waver by a few millimetres, and colours step at knots.
        constexpr float knot = 0.0065f;
        const glm::vec2 k = (glm::floor(p / knot) + 0.5f) * knot;
        const glm::vec2 c = k - metres * 0.5f + 0.006f * glm::vec2(noise.at({k.x * 9, k.y * 9, 1.5f}), noise.at({k.x * 9, k.y * 9, 7.5f}));
        const glm::vec2 inset = metres * 0.5f - glm::abs(c);
        const float edge = std::min(inset.x, inset.y);

        glm::vec3 color = cream;
        if (edge < 0.035f) {
            color = ink;
        } else if (edge < 0.135f) {
            // Border: a row of small triangles on rust.
            const float run = inset.x < inset.y ? c.y : c.x, depth = (edge - 0.035f) / 0.10f;
            const float tooth = std::abs(std::fmod(run + 10.0f, 0.10f) / 0.10f * 2 - 1);
            color = depth > tooth ? rust : cream;
        } else if (edge < 0.15f) {
            color = ink;
        } else {
            // Field: nested lozenges in a lattice.
            const glm::vec2 cell(0.42f, 0.36f), g = c / cell;
            const glm::vec2 f = glm::abs(g - glm::floor(g) - 0.5f);
            const float lozenge = f.x + f.y;
            const bool odd = (int(std::floor(g.x) + std::floor(g.y)) % 2) != 0;
            if (lozenge < 0.09f)
                color = odd ? rust : blue;
            else if (lozenge < 0.13f)
                color = cream;
            else if (lozenge < 0.19f)
                color = ink;
            else if (std::abs(lozenge - 0.5f) < 0.045f)
                color = odd ? blue : rust;
        }
        const float dye = noise.fractal({c.x * 0.8f, c.y * 26, 4.5f}, 3);  // dye lots change between rows
        const float pile = noise.fractal(glm::vec3(p * 160.0f, 0.5f), 3, 0.7f);
        const float wear = noise.fractal(glm::vec3(p * 2.2f, 8.5f), 4);
        Surface s;
        s.color = color * (1 + 0.12f * dye + 0.26f * pile + 0.10f * wear);
        s.roughness = 0.97f;
        s.height = 1.1e-3f * pile + (color == ink ? -5e-4f : 0.0f);
        return s;
    });
}

Mesh curtain(uint32_t seed, float width, float height) {
    const Noise noise{seed};
    Mesh mesh = grid(int(width * 150), 14, [&](float u, float v) {
        // The tape gathers even pleats; farther down they wander, merge and open.
        const float wander = 0.9f * v * noise.fractal({u * 4, v * 1.3f, 0.5f}, 2);
        const float phase = tau * (u * width / 0.105f + wander);
        const float depth = 0.020f + 0.030f * v + 0.012f * noise.at({u * 7, v * 2, 5.5f}) * v;
        const float sway = 0.02f * v * v * noise.at({u * 2, 0.5f, 9.5f});
        const float gathered = 1 - 0.05f * std::sin(v * tau / 2);
        return glm::vec3((u - 0.5f) * width * gathered + 0.010f * std::sin(2 * phase) * v, -v * height, depth * std::sin(phase) + sway);
    });
    scaleUv(mesh, {1.5f * width, height});  // the cloth is half again as long as the span it covers
    return mesh;
}

Mesh rug(uint32_t seed, const glm::vec2& metres) {
    const Noise noise{seed};
    constexpr float thickness = 0.012f;
    Mesh mesh = bent(roundedBox({metres.x, thickness, metres.y}, 0.005f, 2, Axis::x, 16), [&](const glm::vec3& p) {
        const float wave = 0.5f + 0.5f * noise.fractal({p.x * 1.4f, 0.5f, p.z * 1.4f}, 3);
        return glm::vec3(p.x + 0.006f * noise.at({p.z * 3, 1.5f, 0.5f}), p.y + thickness / 2 + (p.y > 0 ? 0.004f * wave : 0.0f),
                         p.z + 0.006f * noise.at({p.x * 3, 4.5f, 0.5f}));
    });
    for (Vertex& v : mesh.vertices) v.uv = {v.position.x / metres.x + 0.5f, v.position.z / metres.y + 0.5f};

    // Fringes: knotted bundles, a centimetre apart, coloured by the border's outermost line of texels.
    Random random(seed);
    for (float side : {-1.0f, 1.0f})
        for (float z = -metres.y / 2 + 0.012f; z < metres.y / 2 - 0.01f; z += 0.011f) {
            const glm::vec3 root(side * (metres.x / 2 - 0.003f), 0.007f, z);
            const glm::vec3 tip = root + glm::vec3(side * random.between(0.035f, 0.055f), -0.005f, random.between(-0.008f, 0.008f));
            const glm::vec3 middle = (root + tip) * 0.5f + glm::vec3(0, 0.001f, random.between(-0.004f, 0.004f));
            const Station bundle[] = {{root, 0.0024f}, {middle, 0.0018f}, {tip, 0.0022f}};
            Mesh tassel = tube(bundle, 4, 90);
            for (Vertex& v : tassel.vertices) v.uv = {0.5f + side * 0.44f, 0.5f + 0.23f * z / metres.y};
            append(mesh, tassel);
        }
    return mesh;
}

}  // namespace lodestir::generate
