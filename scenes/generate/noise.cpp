// SPDX-License-Identifier: MIT
// Lattice noise: see noise.h.
#include "noise.h"

#include <cmath>
#include <limits>

#include "random.h"

namespace lodestir::generate {

namespace {

int wrap(int value, int period) {
    const int rest = value % period;
    return rest < 0 ? rest + period : rest;
}

/// Dot product with one of the twelve cube-edge directions, chosen by the hash.
float slope(uint32_t h, float x, float y, float z) {
    const uint32_t k = h & 15u;
    const float u = k < 8 ? x : y;
    const float v = k < 4 ? y : (k == 12 || k == 14 ? x : z);
    return ((k & 1u) ? -u : u) + ((k & 2u) ? -v : v);
}

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

}  // namespace

uint32_t Noise::corner(glm::ivec3 c, int level) const {
    if (period != glm::ivec3(0))
        for (int axis = 0; axis < 3; ++axis)
            if (period[axis] > 0) c[axis] = wrap(c[axis], period[axis] << level);
    const uint32_t h = uint32_t(c.x) * 0x8da6b343u ^ uint32_t(c.y) * 0xd8163841u ^ uint32_t(c.z) * 0xcb1ab31fu;
    return hash(h + seed * 0x9e3779b9u + uint32_t(level) * 0x632be5abu);
}

float Noise::octave(const glm::vec3& p, int level) const {
    const glm::vec3 base = glm::floor(p);
    const glm::ivec3 c(base);
    const glm::vec3 f = p - base;
    const float u = fade(f.x), v = fade(f.y), w = fade(f.z);

    float planes[2];
    for (int k = 0; k < 2; ++k) {
        const float z = f.z - float(k);
        const float x00 = slope(corner({c.x, c.y, c.z + k}, level), f.x, f.y, z);
        const float x10 = slope(corner({c.x + 1, c.y, c.z + k}, level), f.x - 1, f.y, z);
        const float x01 = slope(corner({c.x, c.y + 1, c.z + k}, level), f.x, f.y - 1, z);
        const float x11 = slope(corner({c.x + 1, c.y + 1, c.z + k}, level), f.x - 1, f.y - 1, z);
        planes[k] = glm::mix(glm::mix(x00, x10, u), glm::mix(x01, x11, u), v);
    }
    return glm::mix(planes[0], planes[1], w);
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
                const uint32_t id = corner(c, 0);
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
