// SPDX-License-Identifier: MIT
// Interpolation of animation channels and the matrices of all nodes at a frame.
#include <framework/scene/animation.h>
#include <framework/scene/flattening.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

glm::quat asQuaternion(const glm::vec4& v) { return glm::quat(v.w, v.x, v.y, v.z); }
glm::vec4 asVector(const glm::quat& q) { return {q.x, q.y, q.z, q.w}; }

glm::vec4 unit(const glm::vec4& v) {
    const float length = glm::length(v);
    return length > 0 ? v / length : glm::vec4(0, 0, 0, 1);
}

/// Cubic Hermite spline between two keys of (in-tangent, value, out-tangent), tangents per second (appendix C.5).
glm::vec4 hermite(const glm::vec4* from, const glm::vec4* to, float t, float duration) {
    const float t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * from[1] + duration * (t3 - 2 * t2 + t) * from[2] + (-2 * t3 + 3 * t2) * to[1] +
           duration * (t3 - t2) * to[0];
}

/// Seconds of the animation at a frame: it repeats.
float timeAt(const Scene& scene, float frame) {
    float time = frame * scene.animationSpeed / scene.framesPerSecond;
    if (scene.animationLength > 0) time = std::fmod(time, scene.animationLength);
    return time < 0 ? time + scene.animationLength : time;
}

}  // namespace

glm::mat4 localMatrix(const Node& node) {
    if (node.matrix) return *node.matrix;
    return glm::translate(glm::mat4(1), node.translation) * glm::mat4_cast(node.rotation) * glm::scale(glm::mat4(1), node.scale);
}

glm::vec4 evaluate(const AnimationChannel& channel, float time) {
    const std::vector<float>& times = channel.times;
    const bool rotation = channel.value == AnimatedValue::rotation, cubic = channel.interpolation == Interpolation::cubic;
    const auto key = [&](std::size_t i) { return channel.values[cubic ? 3 * i + 1 : i]; };
    const auto done = [&](const glm::vec4& value) { return rotation ? unit(value) : value; };

    const auto after = std::upper_bound(times.begin(), times.end(), time);
    if (after == times.begin()) return done(key(0));
    if (after == times.end()) return done(key(times.size() - 1));
    const auto next = static_cast<std::size_t>(after - times.begin()), last = next - 1;
    const float duration = times[next] - times[last], t = (time - times[last]) / duration;
    switch (channel.interpolation) {
    case Interpolation::step: return done(key(last));
    case Interpolation::cubic: return done(hermite(&channel.values[3 * last], &channel.values[3 * next], t, duration));
    case Interpolation::linear: break;
    }
    if (rotation) return asVector(glm::slerp(asQuaternion(unit(key(last))), asQuaternion(unit(key(next))), t));
    return glm::mix(key(last), key(next), t);
}

std::vector<glm::mat4> Scene::nodeMatrices(float frame) const {
    std::vector<glm::mat4> matrices(nodes.size());
    const float time = timeAt(*this, frame);
    std::vector<Node> posed = animation.empty() ? std::vector<Node>{} : nodes;
    for (const AnimationChannel& channel : animation) {
        if (channel.value == AnimatedValue::weight) continue;
        const glm::vec4 value = evaluate(channel, time);
        Node& node = posed[channel.node];
        if (channel.value == AnimatedValue::translation)
            node.translation = glm::vec3(value);
        else if (channel.value == AnimatedValue::scale)
            node.scale = glm::vec3(value);
        else
            node.rotation = asQuaternion(value);
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const glm::mat4 local = localMatrix(animation.empty() ? nodes[i] : posed[i]);
        matrices[i] = nodes[i].parent == none ? local : matrices[nodes[i].parent] * local;
    }
    return matrices;
}

bool Scene::deforms() const { return std::ranges::any_of(meshes, &Mesh::deforms); }

glm::mat4 Scene::instanceMatrix(const Instance& instance, const std::vector<glm::mat4>& nodeMatrices) const {
    const Mesh& mesh = meshes[instance.mesh];
    if (mesh.skin != none) return glm::mat4(1);
    const glm::mat4& matrix = nodeMatrices[instance.node];
    if (mesh.shaper == none) return matrix;
    glm::mat4 placed(sizeOf(matrix));
    placed[3] = matrix[3];
    return placed;
}

std::vector<std::vector<float>> Scene::morphWeights(float frame) const {
    const float time = timeAt(*this, frame);
    std::vector<std::vector<float>> weights;
    for (const Mesh& mesh : meshes) {
        weights.push_back(mesh.weights);
        if (mesh.weights.empty()) continue;
        for (const AnimationChannel& channel : animation)
            if (channel.value == AnimatedValue::weight && channel.node == mesh.node && channel.target < mesh.weights.size())
                weights.back()[channel.target] = evaluate(channel, time).x;
    }
    return weights;
}

}  // namespace lodestir
