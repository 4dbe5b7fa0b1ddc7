// SPDX-License-Identifier: MIT
// Axis-aligned boxes around points.
#pragma once
#include <glm/glm.hpp>

#include <span>

namespace lodestir {

/// Holds nothing until something is added.
struct Box {
    glm::vec3 low{1e30f}, high{-1e30f};

    void add(glm::vec3 point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    void add(const Box& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    bool isEmpty() const { return low.x > high.x; }
};

inline Box boundsOf(std::span<const glm::vec3> points) {
    Box box;
    for (const glm::vec3& p : points) box.add(p);
    return box;
}

/// The box around the corners of a box after a transform.
inline Box transformed(const Box& box, const glm::mat4& matrix) {
    Box out;
    if (box.isEmpty()) return out;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y, corner & 4 ? box.high.z : box.low.z);
        out.add(glm::vec3(matrix * glm::vec4(p, 1)));
    }
    return out;
}

}  // namespace lodestir
