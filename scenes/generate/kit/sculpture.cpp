// SPDX-License-Identifier: MIT
// Soft clay: see sculpture.h.
#include "sculpture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace lodestir::generate {

namespace {

constexpr int block = 8;  ///< cells along a block, which is passed over where the surface is far

/// Distances that parts give may be too long by this factor: of flat ellipsoids, and of what is slim.
constexpr float overestimate = 2.5f;

float smoothMinimum(float a, float b, float k) {
    const float h = std::max(k - std::abs(a - b), 0.0f) / k;
    return std::min(a, b) - h * h * k * 0.25f;
}

struct CellHash {
    size_t operator()(const glm::ivec3& c) const { return size_t(c.x) * 73856093u ^ size_t(c.y) * 19349663u ^ size_t(c.z) * 83492791u; }
};

}  // namespace

float Sculpture::Part::distance(glm::vec3 p) const {
    p = glm::vec3(toLocal * glm::vec4(p, 1));
    p.z /= slim;
    if (isRound) {
        // First-order distance of the ellipsoid: exact on it and in the limit of a sphere.
        const glm::vec3 unit = p / to;
        const float k = glm::length(unit), steep = glm::length(unit / to);
        return steep > 0 ? k * (k - 1) / steep : -std::min({to.x, to.y, to.z});
    }
    // The cone's generator leans by the difference of radii: the nearest circle lies that much farther along the axis.
    const glm::vec3 axis = to - from, q = p - from;
    const float length = glm::length(axis), lean = std::clamp((fromRadius - toRadius) / length, -0.95f, 0.95f);
    const float along = glm::dot(q, axis) / length, away = std::sqrt(std::max(glm::dot(q, q) - along * along, 0.0f));
    const float t = std::clamp((along + away * lean / std::sqrt(1 - lean * lean)) / length, 0.0f, 1.0f);
    return (glm::distance(q, axis * t) - glm::mix(fromRadius, toRadius, t)) * slim;
}

void Sculpture::limb(std::span<const Station> stations) {
    for (size_t i = 1; i < stations.size(); ++i)
        parts.push_back(
            {glm::inverse(frame), blend, slim, false, false, stations[i - 1].position, stations[i].position, stations[i - 1].radius, stations[i].radius});
}

void Sculpture::lump(const glm::vec3& centre, const glm::mat3& axes) { ellipsoid(centre, axes, false); }
void Sculpture::hollow(const glm::vec3& centre, const glm::mat3& axes) { ellipsoid(centre, axes, true); }

void Sculpture::ellipsoid(const glm::vec3& centre, const glm::mat3& axes, bool isCarved) {
    const glm::vec3 lengths(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
    const glm::mat4 place(glm::vec4(axes[0] / lengths.x, 0), glm::vec4(axes[1] / lengths.y, 0), glm::vec4(axes[2] / lengths.z, 0), glm::vec4(centre, 1));
    parts.push_back({glm::inverse(frame * place), blend, 1, isCarved, true, {}, lengths, 0, 0});
}

float Sculpture::distance(const glm::vec3& p, std::span<const Part> near) const {
    float d = 1e3f;
    for (const Part& part : near) d = part.isCarved ? -smoothMinimum(-d, part.distance(p), part.blend) : smoothMinimum(d, part.distance(p), part.blend);
    return relief ? d - relief(p) : d;
}

float Sculpture::distance(const glm::vec3& p) const { return distance(p, parts); }

glm::vec3 Sculpture::slope(const glm::vec3& p, std::span<const Part> near, float step) const {
    glm::vec3 g(0);
    for (const glm::vec3& corner : {glm::vec3(1, -1, -1), glm::vec3(-1, -1, 1), glm::vec3(-1, 1, -1), glm::vec3(1, 1, 1)})
        g += corner * distance(p + step * corner, near);
    return g / (4 * step);
}

Mesh Sculpture::mesh(float cell) const {
    glm::vec3 low(1e9f), high(-1e9f);
    for (const Part& part : parts) {
        if (part.isCarved) continue;
        const glm::mat4 place = glm::inverse(part.toLocal);
        const float reach = part.isRound ? std::max({part.to.x, part.to.y, part.to.z}) : std::max(part.fromRadius, part.toRadius);
        for (const glm::vec3& end : {part.from, part.isRound ? part.from : part.to}) {
            const glm::vec3 p(place * glm::vec4(end.x, end.y, end.z * part.slim, 1));
            low = glm::min(low, p - reach - part.blend), high = glm::max(high, p + reach + part.blend);
        }
    }

    Mesh mesh;
    std::unordered_map<glm::ivec3, uint32_t, CellHash> vertexOf;
    struct Crossing {
        glm::ivec3 at;
        int axis;
        bool isLeaving;  ///< inside at its start
    };
    std::vector<Crossing> crossings;
    constexpr int side = block + 1;
    std::array<float, side * side * side> values;
    const auto valueAt = [&](const glm::ivec3& p) { return values[size_t((p.z * side + p.y) * side + p.x)]; };
    const glm::ivec3 blocks = glm::ivec3(glm::ceil((high - low) / (cell * block)));
    const float reach = 0.87f * cell * block;  // half a diagonal
    std::vector<Part> near;
    for (int bz = 0; bz < blocks.z; ++bz)
        for (int by = 0; by < blocks.y; ++by)
            for (int bx = 0; bx < blocks.x; ++bx) {
                const glm::ivec3 first = glm::ivec3(bx, by, bz) * block;
                const size_t firstVertex = mesh.vertices.size();
                const glm::vec3 middle = low + cell * (glm::vec3(first) + 0.5f * block);
                if (std::abs(distance(middle)) > overestimate * reach) continue;
                near.clear();
                for (const Part& part : parts)
                    if (part.distance(middle) < 2 * overestimate * reach + 2 * part.blend) near.push_back(part);
                for (int z = 0; z < side; ++z)
                    for (int y = 0; y < side; ++y)
                        for (int x = 0; x < side; ++x)
                            values[size_t((z * side + y) * side + x)] = distance(low + cell * glm::vec3(first + glm::ivec3(x, y, z)), near);
                for (int z = 0; z < block; ++z)
                    for (int y = 0; y < block; ++y)
                        for (int x = 0; x < block; ++x) {
                            const glm::ivec3 c(x, y, z);
                            for (int axis = 0; axis < 3; ++axis) {
                                glm::ivec3 next = c;
                                ++next[axis];
                                if ((valueAt(c) < 0) != (valueAt(next) < 0)) crossings.push_back({first + c, axis, valueAt(c) < 0});
                            }
                            // Mean of where the surface cuts the cell's twelve edges.
                            glm::vec3 sum(0);
                            int count = 0;
                            for (int axis = 0; axis < 3; ++axis)
                                for (int k = 0; k < 4; ++k) {
                                    glm::ivec3 from = c;
                                    from[(axis + 1) % 3] += k & 1, from[(axis + 2) % 3] += k >> 1;
                                    glm::ivec3 to = from;
                                    ++to[axis];
                                    const float a = valueAt(from), b = valueAt(to);
                                    if ((a < 0) == (b < 0)) continue;
                                    sum += glm::mix(glm::vec3(from), glm::vec3(to), a / (a - b)), ++count;
                                }
                            if (count) vertexOf[first + c] = mesh.add({.position = low + cell * (glm::vec3(first) + sum / float(count))});
                        }
                for (Vertex& v : std::span(mesh.vertices).subspan(firstVertex)) {
                    for (int i = 0; i < 2; ++i) {  // Newton's method; never out of reach of the cell, or its neighbours would fold over it
                        const glm::vec3 g = slope(v.position, near, 0.25f * cell);
                        v.position -= g * std::clamp(distance(v.position, near) / std::max(glm::dot(g, g), 0.1f), -0.3f * cell, 0.3f * cell);
                    }
                    v.normal = glm::normalize(slope(v.position, near, 0.5f * cell));
                }
            }

    for (const Crossing& c : crossings) {
        // The four cells around the edge, counter-clockwise seen from its end.
        glm::ivec3 right(0), up(0);
        right[(c.axis + 1) % 3] = 1, up[(c.axis + 2) % 3] = 1;
        std::array<uint32_t, 4> ring{};
        const glm::ivec3 cells[] = {c.at - right - up, c.at - up, c.at, c.at - right};
        for (size_t k = 0; k < 4; ++k) {
            const auto found = vertexOf.find(cells[k]);
            if (found == vertexOf.end()) throw std::logic_error("a surface leaves the blocks it was looked for in");
            ring[k] = found->second;
        }
        if (!c.isLeaving) std::swap(ring[1], ring[3]);
        const auto at = [&](size_t k) { return mesh.vertices[ring[k]].position; };
        if (glm::distance(at(0), at(2)) < glm::distance(at(1), at(3)))
            mesh.quad(ring[0], ring[1], ring[2], ring[3]);
        else
            mesh.quad(ring[1], ring[2], ring[3], ring[0]);
    }
    return mesh;
}

}  // namespace lodestir::generate
