// SPDX-License-Identifier: MIT
// A cobra that sways over its coils: joints bend its mesh in every frame, and it has levels. One of the still lifes that bias is judged by
// (kit/still_life.h).
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "kit/motion.h"
#include "kit/scene.h"
#include "kit/spline.h"
#include "kit/still_life.h"

namespace lodestir::generate {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float lowest = 0.14f, jointStep = 0.20f;  ///< metres: height of the body's joint, and from each joint to the next
constexpr int jointCount = 4;
constexpr glm::vec3 eye(0.044f, 0.945f, 0.135f);

/// The cobra at rest, from tail to mouth: two turns of coil, then upright, its head toward +z.
Mesh body() {
    std::vector<Station> axis;
    for (int i = 0; i <= 16; ++i) {
        const float t = float(i) / 16, angle = 4 * pi * t, radius = 0.50f - 0.36f * t;
        axis.push_back({{radius * std::cos(angle), 0.075f, radius * std::sin(angle)}, 0.012f + 0.060f * std::min(2.5f * t, 1.0f)});
    }
    const Station upright[] = {{{0, 0.17f, 0.06f}, 0.072f},  {{0, 0.32f, 0}, 0.066f},     {{0, 0.50f, -0.02f}, 0.064f}, {{0, 0.68f, -0.01f}, 0.068f},
                               {{0, 0.84f, 0.01f}, 0.062f}, {{0, 0.92f, 0.06f}, 0.060f}, {{0, 0.925f, 0.14f}, 0.050f}, {{0, 0.90f, 0.21f}, 0.026f}};
    axis.insert(axis.end(), std::begin(upright), std::end(upright));
    Mesh mesh = bent(limb(axis, 6, 32), [](const glm::vec3& p) {
        const float hood = glm::smoothstep(0.46f, 0.68f, p.y) * glm::smoothstep(0.90f, 0.78f, p.y);
        return p * glm::vec3(1 + 1.3f * hood, 1, 1 - 0.45f * hood);
    });
    glm::vec2 size(0);
    for (const Vertex& v : mesh.vertices) size = glm::max(size, v.uv);
    scaleUv(mesh, 1.0f / size);
    return mesh;
}

/// Bands along a dark back, a pale throat, dark eyes.
void paint(Mesh& mesh) {
    mesh.hasColors = true;
    for (Vertex& v : mesh.vertices) {
        const float band = glm::smoothstep(0.35f, 0.65f, 0.5f + 0.5f * std::sin(2 * pi * 26 * v.uv.y));
        const float throat = glm::smoothstep(0.2f, 0.6f, v.normal.z) * glm::smoothstep(0.20f, 0.34f, v.position.y);
        v.color = glm::mix(glm::vec3(0.16f, 0.22f, 0.09f), glm::vec3(0.62f, 0.50f, 0.16f), band);
        v.color = glm::mix(v.color, glm::mix(glm::vec3(0.72f, 0.60f, 0.36f), glm::vec3(0.42f, 0.22f, 0.10f), band), throat);
        if (glm::distance(glm::vec3(std::abs(v.position.x), v.position.y, v.position.z), eye) < 0.020f) v.color = glm::vec3(0.02f);
    }
}

/// Half of each of two joints at the upper one's height, all of the lower one half a step below.
Hold holdAt(float height) {
    const float row = std::clamp((height - lowest) / jointStep - 0.5f, 0.0f, float(jointCount - 1));
    const int low = std::min(int(row), jointCount - 2);
    const float share = row - float(low);
    return {.joints = {low, low + 1, 0, 0}, .shares = {1 - share, share, 0, 0}};
}

void addCobra(Composition& c) {
    Mesh mesh = body();
    paint(mesh);
    std::vector<Hold> holds;
    for (const Vertex& v : mesh.vertices) holds.push_back(holdAt(v.position.y));
    const int geometry = c.glb.addGeometry(mesh);
    c.glb.hold(geometry, holds);
    const int node = c.glb.addNode("cobra", c.glb.addMesh("cobra", {{geometry, c.paint("scales", glm::vec3(1))}}),
                                   {.translation = {0, 0.16f, -0.1f}, .rotation = turnY(12)});
    std::vector<Joint> joints;
    for (int i = 0; i < jointCount; ++i) joints.push_back({"joint " + std::to_string(i), {0, lowest + jointStep * float(i), 0}, i - 1});
    const std::vector<int> nodes = c.glb.addSkin(node, joints);
    // A wave runs up the neck; the coils lie still.
    for (int i = 1; i < jointCount; ++i)
        animate(c.glb, nodes[size_t(i)], Motion::rotation, loopPieces, [i](float t) {
            const float phase = 2 * pi * t - 0.5f * float(i - 1);
            return asVector(glm::angleAxis(0.34f * std::sin(phase), glm::vec3(0, 0, 1)) * glm::angleAxis(0.14f * std::cos(phase), glm::vec3(1, 0, 0)));
        });
}

Glb makeEnsembleSkinned() {
    Composition c;
    const int wall = c.paint("wall", {0.60f, 0.56f, 0.50f}), floor = c.paint("floor", {0.46f, 0.36f, 0.28f}), left = c.paint("left", {0.20f, 0.32f, 0.42f}),
              right = c.paint("right", {0.50f, 0.26f, 0.14f}), chalk = c.paint("chalk", {0.76f, 0.72f, 0.66f}),
              glaze = c.gloss("glaze", {0.42f, 0.12f, 0.08f}, 0.3f);
    c.glb.addNode(chamber({}, {floor, wall, wall, wall, left, right}));
    c.glb.addNode(areaLamp("lamp", c.lamp("light", {10.5f, 9.4f, 7.8f}), wall, {-0.5f, 1.9f, 0.5f}, {0.15f, -1, -0.2f}, {1.0f, 0.8f}));
    c.block("stage", chalk, {1.5f, 0.16f, 1.2f}, {0, 0, -0.1f}, 6);
    addCobra(c);
    c.put("jug", glaze, jug(20), {.translation = {-1.05f, 0, -0.6f}, .scale = glm::vec3(0.72f)});
    return std::move(c.glb);
}

}  // namespace

LODESTIR_SCENE(makeEnsembleSkinned, "--levels 3 --ratio 4 --mesh cobra")

}  // namespace lodestir::generate
