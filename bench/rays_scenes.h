// SPDX-License-Identifier: MIT
// The three procedural scenes that rays are measured in: a closed room with a bumpy floor, filled with displaced spheres.
#pragma once
#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace lodestir::bench {

struct Triangles {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;

    void append(const Triangles& other, const glm::mat4& transform = glm::mat4(1)) {
        const auto base = std::uint32_t(positions.size());
        for (const glm::vec3 p : other.positions) positions.emplace_back(transform * glm::vec4(p, 1));
        for (const glm::uvec3 t : other.triangles) triangles.push_back(t + base);
    }
};

struct Placed {
    std::uint32_t mesh;
    glm::mat4 toWorld;
};

struct RayScene {
    std::string name;
    std::vector<Triangles> meshes;
    std::vector<Placed> instances;

    /// All instances' triangles in world space, in the order of the instances.
    Triangles flat() const {
        Triangles all;
        for (const Placed& i : instances) all.append(meshes[i.mesh], i.toWorld);
        return all;
    }
};

/// A number in [0, 1) that depends on `x` alone (integer hash by C. Wellons, "lowbias32").
inline float random(std::uint32_t x) {
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return float((x ^ x >> 16) >> 8) * 0x1p-24f;
}

/// n x n quads spanned by u and v, raised by `height` along y.
inline Triangles makePatch(glm::vec3 origin, glm::vec3 u, glm::vec3 v, std::uint32_t n,
                           const std::function<float(float, float)>& height = [](float, float) { return 0.0f; }) {
    Triangles patch;
    for (std::uint32_t j = 0; j <= n; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) {
            const float s = float(i) / float(n), t = float(j) / float(n);
            patch.positions.push_back(origin + s * u + t * v + glm::vec3(0, height(s, t), 0));
        }
    }
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i, b = a + n + 1;
            patch.triangles.emplace_back(a, a + 1, b + 1);
            patch.triangles.emplace_back(a, b + 1, b);
        }
    }
    return patch;
}

/// A unit sphere of `around` x `down` quads with waves on it.
inline Triangles makeBumpySphere(std::uint32_t around, std::uint32_t down, float phase) {
    constexpr float pi = std::numbers::pi_v<float>;
    Triangles sphere;
    for (std::uint32_t j = 0; j <= down; ++j) {
        for (std::uint32_t i = 0; i < around; ++i) {
            const float theta = pi * float(j) / float(down), phi = 2 * pi * float(i) / float(around);
            const float r = 1 + 0.12f * std::sin(7 * phi + phase) * std::sin(5 * theta)
                              + 0.03f * std::sin(31 * phi) * std::sin(23 * theta + phase);
            sphere.positions.push_back(r * glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)));
        }
    }
    for (std::uint32_t j = 0; j < down; ++j) {
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t a = j * around + i, b = j * around + (i + 1) % around, c = a + around, d = b + around;
            if (j > 0) sphere.triangles.emplace_back(a, b, d);
            if (j + 1 < down) sphere.triangles.emplace_back(a, d, c);
        }
    }
    return sphere;
}

/// The room, 12 x 5 x 12: floor of `floor` x `floor` quads, walls and ceiling of `wall` x `wall`.
inline Triangles makeRoom(std::uint32_t floor, std::uint32_t wall) {
    const float x = 12, y = 5, z = 12, below = 0.3f;
    Triangles room = makePatch({0, 0, 0}, {x, 0, 0}, {0, 0, z}, floor, [](float s, float t) {
        return 0.15f * std::sin(s * 40) * std::cos(t * 37) + 0.04f * std::sin(s * 171 + t * 130);
    });
    room.append(makePatch({0, y, 0}, {x, 0, 0}, {0, 0, z}, wall));
    for (const float side : {0.0f, x}) room.append(makePatch({side, -below, 0}, {0, y + below, 0}, {0, 0, z}, wall));
    for (const float side : {0.0f, z}) room.append(makePatch({0, -below, side}, {x, 0, 0}, {0, y + below, 0}, wall));
    return room;
}

/// One mesh: the room with `count` spheres in it.
inline RayScene makeSpheres(const std::string& name, std::uint32_t floor, std::uint32_t wall, std::uint32_t count, std::uint32_t around,
                            std::uint32_t down) {
    Triangles mesh = makeRoom(floor, wall);
    for (std::uint32_t k = 0; k < count; ++k) {
        const glm::vec3 center(0.8f + random(k * 5 + 1) * 10.4f, 0.3f + random(k * 5 + 2) * 3.8f, 2.5f + random(k * 5 + 3) * 8.7f);
        const float radius = 0.25f + 0.55f * random(k * 5 + 4);
        glm::mat4 place(radius);
        place[3] = glm::vec4(center, 1);
        mesh.append(makeBumpySphere(around, down, float(k)), place);
    }
    return {name, {std::move(mesh)}, {{0, glm::mat4(1)}}};
}

/// The room with 400 instances of one sphere, each turned and stretched in its own way.
inline RayScene makeInstances() {
    RayScene scene{"i", {makeRoom(24, 2), makeBumpySphere(94, 48, 0)}, {{0, glm::mat4(1)}}};
    for (std::uint32_t k = 0; k < 400; ++k) {
        const auto draw = [&](std::uint32_t n) { return random(k * 9 + n); };
        const glm::vec3 axis = glm::normalize(glm::vec3(draw(4), draw(5), draw(6)) - 0.5f);
        const float angle = 6.28f * draw(7), size = 0.12f + 0.28f * draw(8), stretch = 0.6f + 0.8f * draw(9);
        const float c = std::cos(angle), s = std::sin(angle);
        const glm::mat3 cross(glm::vec3(0, axis.z, -axis.y), glm::vec3(-axis.z, 0, axis.x), glm::vec3(axis.y, -axis.x, 0));
        const glm::mat3 turn = c * glm::mat3(1) + s * cross + (1 - c) * glm::outerProduct(axis, axis);  // Rodrigues
        const glm::mat3 scale(glm::vec3(size, 0, 0), glm::vec3(0, size * stretch, 0), glm::vec3(0, 0, size));
        glm::mat4 place(turn * scale);
        place[3] = glm::vec4(0.5f + draw(1) * 11, 0.3f + draw(2) * 4.2f, 2 + draw(3) * 9.5f, 1);
        scene.instances.push_back({1, place});
    }
    return scene;
}

/// "a": 9 k triangles, "b": 480 k triangles, "i": 400 instances (3.5 M triangles when flattened).
inline RayScene makeRayScene(char name) {
    if (name == 'a') return makeSpheres("a", 24, 2, 25, 22, 8);
    if (name == 'b') return makeSpheres("b", 280, 10, 60, 100, 28);
    return makeInstances();
}

}  // namespace lodestir::bench
