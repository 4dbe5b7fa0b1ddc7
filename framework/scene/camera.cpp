// SPDX-License-Identifier: MIT
// Where the camera is at a frame, and where it goes when nobody says.
#include <framework/scene/axes.h>
#include <framework/scene/camera.h>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

CameraKey mixKeys(const CameraKey& a, const CameraKey& b, float t) {
    return {
        .frame = glm::mix(a.frame, b.frame, t),
        .position = glm::mix(a.position, b.position, t),
        .target = glm::mix(a.target, b.target, t),
        .up = glm::mix(a.up, b.up, t),
        .fovy = glm::mix(a.fovy, b.fovy, t),
        .height = glm::mix(a.height, b.height, t),
        .aperture = glm::mix(a.aperture, b.aperture, t),
        .focus = glm::mix(a.focus, b.focus, t),
    };
}

CameraKey keyAt(const std::vector<CameraKey>& keys, float frame) {
    if (keys.empty()) return {};
    const auto after = std::upper_bound(keys.begin(), keys.end(), frame, [](float f, const CameraKey& key) { return f < key.frame; });
    CameraKey key = after == keys.begin() ? keys.front()
                    : after == keys.end() ? keys.back()
                                          : mixKeys(after[-1], *after, (frame - after[-1].frame) / (after->frame - after[-1].frame));
    key.frame = frame;
    return key;
}

}  // namespace

CameraKey Scene::cameraAt(float frame) const {
    CameraKey key = keyAt(camera.keys, frame);
    if (camera.node == none) return key;
    const glm::mat4 pose = nodeMatrices(frame)[camera.node];
    const glm::mat3 axes = unitAxes(pose);
    key.position = glm::vec3(pose[3]);
    key.target = key.position - axes[2] * key.focus;
    key.up = axes[1];
    return key;
}

CameraKey frameBounds(const std::array<glm::vec3, 2>& bounds) {
    constexpr float fovy = 0.66f, aspect = 16.0f / 9, margin = 1.08f;  // 38 degrees: a longish normal lens, little distortion
    const bool empty = bounds[0].x > bounds[1].x;
    const glm::vec3 low = empty ? glm::vec3(-1) : bounds[0], high = empty ? glm::vec3(1) : bounds[1];
    const glm::vec3 target = 0.5f * (low + high);
    const glm::vec3 back = glm::normalize(glm::vec3(0.55f, 0.4f, 1)), right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), back)),
                    up = glm::cross(back, right);
    const float tangent = std::tan(fovy / 2);
    float distance = 1e-6f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p = glm::vec3(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z) - target;
        const float side = std::max(std::abs(glm::dot(p, up)) / tangent, std::abs(glm::dot(p, right)) / (tangent * aspect));
        distance = std::max(distance, margin * side + glm::dot(p, back));
    }
    return {.position = target + back * distance, .target = target, .fovy = fovy, .focus = distance};
}

}  // namespace lodestir
