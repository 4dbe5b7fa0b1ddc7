// SPDX-License-Identifier: MIT
#include <framework/app/orbit_camera.h>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lodestir {
namespace {

struct Axes {
    glm::vec3 right, up, forward;
};

Axes axesOf(const CameraKey& camera) {
    const glm::vec3 forward = glm::normalize(camera.target - camera.position);
    glm::vec3 right = glm::cross(forward, camera.up);
    if (glm::dot(right, right) < 1e-12f) right = glm::cross(forward, glm::vec3(0, 0, 1));  // looking straight along `up`
    right = glm::normalize(right);
    return {right, glm::cross(right, forward), forward};
}

/// Columns: right, down and forward, so that M (x, y, 1) with x and y in 0..1 is the direction of a place in the picture.
glm::mat3 directions(const CameraKey& camera, float aspect) {
    const Axes axes = axesOf(camera);
    const float height = std::tan(0.5f * camera.fovy);
    const glm::vec3 right = 2 * height * aspect * axes.right, down = -2 * height * axes.up;
    return {right, down, axes.forward - 0.5f * right - 0.5f * down};
}

Json vectorJson(const glm::vec3& v) {
    Json array = Json::array();
    for (int i = 0; i < 3; ++i) array.push(std::strtod(fmt::format("{:.6g}", v[i]).c_str(), nullptr));
    return array;
}

Json numberJson(float value) { return Json(std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr)); }

}  // namespace

CameraKey orbited(const CameraKey& camera, float right, float up) {
    constexpr float least = 0.02f;  // radians between view and `up`
    CameraKey moved = camera;
    const glm::vec3 pole = glm::normalize(camera.up);
    const glm::mat3 turn(glm::rotate(glm::mat4(1), right, pole));
    glm::vec3 back = turn * (camera.position - camera.target);
    const glm::vec3 side = turn * axesOf(camera).right;
    const float angle = std::acos(std::clamp(glm::dot(glm::normalize(back), pole), -1.0f, 1.0f));
    const float tilt = std::clamp(angle - up, least, glm::pi<float>() - least) - angle;
    back = glm::mat3(glm::rotate(glm::mat4(1), tilt, side)) * back;
    moved.position = camera.target + back;
    return moved;
}

CameraKey panned(const CameraKey& camera, float right, float up) {
    const Axes axes = axesOf(camera);
    const float height = 2 * std::tan(0.5f * camera.fovy) * glm::length(camera.target - camera.position);
    const glm::vec3 shift = height * (right * axes.right + up * axes.up);
    CameraKey moved = camera;
    moved.position += shift;
    moved.target += shift;
    return moved;
}

CameraKey dollied(const CameraKey& camera, float factor) {
    CameraKey moved = camera;
    const float distance = glm::length(camera.position - camera.target), wanted = std::clamp(distance * factor, 1e-4f, 1e6f);
    moved.position = camera.target + (camera.position - camera.target) * (wanted / distance);
    moved.focus = std::max(camera.focus + wanted - distance, 1e-4f);
    return moved;
}

CameraKey framed(const CameraKey& camera, const std::array<glm::vec3, 2>& bounds, float aspect) {
    if (bounds[0].x > bounds[1].x) return camera;
    const float radius = std::max(0.5f * glm::length(bounds[1] - bounds[0]), 1e-4f);
    const float half = std::atan(std::tan(0.5f * camera.fovy) * std::min(aspect, 1.0f));
    CameraKey moved = camera;
    moved.target = 0.5f * (bounds[0] + bounds[1]);
    moved.position = moved.target - axesOf(camera).forward * (radius / std::sin(half));
    moved.focus = glm::length(moved.position - moved.target);
    return moved;
}

Json cameraJson(const CameraKey& camera) {
    Json json = Json::object();
    json["position"] = vectorJson(camera.position);
    json["target"] = vectorJson(camera.target);
    json["up"] = vectorJson(camera.up);
    json["fovy"] = numberJson(glm::degrees(camera.fovy));
    json["aperture"] = numberJson(camera.aperture);
    json["focus"] = numberJson(camera.focus);
    return json;
}

glm::mat3 warpBetween(const CameraKey& from, const CameraKey& to, float aspect) {
    const glm::vec3 normal = axesOf(from).forward;
    // A ray of `to`, C + t d, meets the plane at t = n.(P - C) / n.d; seen from `from`'s centre, and times n.d, that is linear in d.
    const glm::mat3 meet = glm::outerProduct(to.position - from.position, normal) + glm::mat3(glm::dot(normal, from.target - to.position));
    return glm::inverse(directions(from, aspect)) * meet * directions(to, aspect);
}

}  // namespace lodestir
