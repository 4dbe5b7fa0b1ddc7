// SPDX-License-Identifier: MIT
// Lattice noise: see noise.h.
#include "noise.h"

#include <cmath>
#include <limits>

#include "random.h"

namespace lodestir::generate {

namespace {

/// The twelve edge directions of a cube, four of them twice (Perlin 2002): sixteen for a hash's four bits.
constexpr float directions[16][3] = {{1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
                                     {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}, {1, 1, 0}, {-1, 1, 0}, {0, -1, 1}, {0, -1, -1}};

constexpr uint32_t axisKeys[3] = {0x8da6b343u, 0xd8163841u, 0xcb1ab31fu};

int wrap(int value, int period) {
    if (period <= 0) return value;
    const int rest = value % period;
    return rest < 0 ? rest + period : rest;
}

/// Last step of the lattice hash; the axes' products are added up before, so that a cell's corners share them.
uint32_t mix(uint32_t h) {
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return h ^ (h >> 15);
}

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

}  // namespace

float Noise::octave(const glm::vec3& p, int level) const {
    const glm::vec3 base(std::floor(p.x), std::floor(p.y), std::floor(p.z));
    const glm::vec3 f = p - base;
    uint32_t keys[3][2];
    for (int axis = 0; axis < 3; ++axis) {
        const int c = int(base[axis]), turn = period[axis] << level;
        for (int k = 0; k < 2; ++k) keys[axis][k] = uint32_t(wrap(c + k, turn)) * axisKeys[axis];
    }
    const uint32_t key = seed * 0x9e3779b9u + uint32_t(level) * 0x632be5abu;
    const auto corner = [&](int x, int y, int z) {
        const float* g = directions[mix(key + keys[0][x] + keys[1][y] + keys[2][z]) >> 28];
        return g[0] * (f.x - float(x)) + g[1] * (f.y - float(y)) + g[2] * (f.z - float(z));
    };
    const float u = fade(f.x), v = fade(f.y), w = fade(f.z);
    const auto along = [&](int y, int z) {
        const float a = corner(0, y, z);
        return a + u * (corner(1, y, z) - a);
    };
    const float y00 = along(0, 0), y01 = along(0, 1);
    const float z0 = y00 + v * (along(1, 0) - y00), z1 = y01 + v * (along(1, 1) - y01);
    return z0 + w * (z1 - z0);
}

float Noise::fractal(const glm::vec3& p, int octaves, float gain) const {
    float sum = 0, weight = 1, total = 0, scale = 1;
    for (int i = 0; i < octaves; ++i, weight *= gain, scale *= 2) {
        sum += weight * octave(p * scale, i);
        total += weight;
    }
    return sum / total;
}

float Noise::ridged(const glm::vec3& p, int octaves, float gain) const {
    float sum = 0, weight = 1, total = 0, scale = 1, crest = 1;
    for (int i = 0; i < octaves; ++i, weight *= gain, scale *= 2) {
        const float ridge = 1 - std::abs(octave(p * scale, i));
        const float sharp = ridge * ridge * crest;
        sum += weight * sharp;
        total += weight;
        crest = glm::clamp(sharp * 1.6f, 0.0f, 1.0f);
    }
    return sum / total;
}

Cell Noise::cell(const glm::vec3& p) const {
    const glm::ivec3 home(glm::floor(p));
    Cell best{std::numeric_limits<float>::max(), std::numeric_limits<float>::max(), 0};
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const glm::ivec3 c = home + glm::ivec3(x, y, z);
                uint32_t h = seed * 0x9e3779b9u;
                for (int axis = 0; axis < 3; ++axis) h += uint32_t(wrap(c[axis], period[axis])) * axisKeys[axis];
                const uint32_t id = mix(h);
                // Ten bits of the hash place the feature along each axis.
                const glm::vec3 jitter = (glm::vec3(id & 1023u, (id >> 10) & 1023u, (id >> 20) & 1023u) + 0.5f) / 1024.0f;
                const glm::vec3 offset = glm::vec3(c) + jitter - p;
                const float distance = glm::dot(offset, offset);
                if (distance < best.nearest)
                    best = {distance, best.nearest, id};
                else if (distance < best.second)
                    best.second = distance;
            }
    return {std::sqrt(best.nearest), std::sqrt(best.second), best.id};
}

}  // namespace lodestir::generate
