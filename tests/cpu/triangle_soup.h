// SPDX-License-Identifier: MIT
// Triangles and rays to try hierarchies with, and answers found without one.
#pragma once
#include <framework/scene/bvh/bvh.h>

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace lodestir::test {

struct Soup {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;

    void add(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        const auto first = std::uint32_t(positions.size());
        positions.insert(positions.end(), {a, b, c});
        triangles.emplace_back(first, first + 1, first + 2);
    }
};

/// Numbers that are the same with every standard library.
class Draws {
public:
    explicit Draws(std::uint32_t seed) : engine_(seed) {}
    float number(float low, float high) { return low + (high - low) * float(engine_() >> 8) * 0x1p-24f; }
    glm::vec3 point(float low = 0, float high = 1) {
        const float x = number(low, high), y = number(low, high), z = number(low, high);
        return {x, y, z};
    }

private:
    std::mt19937 engine_;
};

/// `count` triangles in the unit cube with corners up to `size` apart.
inline Soup randomSoup(std::uint32_t seed, std::size_t count, float size) {
    Draws draws(seed);
    Soup soup;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 at = draws.point();
        const glm::vec3 b = at + draws.point(-size, size), c = at + draws.point(-size, size);
        soup.add(at, b, c);
    }
    return soup;
}

struct TestRay {
    glm::vec3 origin, direction;
};

struct TestHit {
    float t = std::numeric_limits<float>::infinity();
    std::uint32_t triangle = bvh_ref::empty;
};

/// The shaders' formula (trace/triangle.glsl), in the numbers of T; misses and NaN give infinity.
template <class T> T meet(glm::vec<3, T> origin, glm::vec<3, T> direction, glm::vec<3, T> v0, glm::vec<3, T> e1, glm::vec<3, T> e2) {
    const auto p = glm::cross(direction, e2), s = origin - v0, q = glm::cross(s, e1);
    const T inverse = 1 / glm::dot(e1, p);
    const T u = glm::dot(s, p) * inverse, v = glm::dot(direction, q) * inverse, t = glm::dot(e2, q) * inverse;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 ? t : std::numeric_limits<T>::infinity();
}

}  // namespace lodestir::test
