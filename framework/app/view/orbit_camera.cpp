// SPDX-License-Identifier: MIT
#include <framework/app/view/orbit_camera.h>

#include <framework/scene/axes.h>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lodestir {
namespace {

constexpr float nearest = 1e-6f, farthest = 1e12f;  // scene units: of targets and pictures, so that no product of them overflows

/// Height of the picture in the plane at right angles to the view through the target.
float heightAtTarget(const CameraKey& camera) {
    return camera.height > 0 ? camera.height : 2 * std::tan(0.5f * camera.fovy) * glm::length(camera.target - camera.position);
}

/// A picture of the world: from a place in it, (x, y, 1) with x and y in 0..1 to the right and downwards, goes a ray. Perspective: origin `base`, direction
/// axes * (x, y, 1). Orthographic: origin base + axes * (x, y, 0), direction the last of the axes.
struct Projection {
    glm::vec3 base;
    glm::mat3 axes;
    bool orthographic;

    Projection(const CameraKey& camera, float aspect) : base(camera.position), orthographic(camera.height > 0) {
        const ViewAxes view = viewAxes(camera);
        const float height = orthographic ? camera.height : 2 * std::tan(0.5f * camera.fovy);
        const glm::vec3 right = height * aspect * view.right, down = -height * view.up, corner = -0.5f * right - 0.5f * down;
        axes = {right, down, orthographic ? view.forward : view.forward + corner};
        if (orthographic) base += corner;
    }
};

/// A number with six digits, or as many as it takes for what it is read as to be `value`.
template <class ReadBack> Json numberJson(float value, float written, const ReadBack& readBack) {
    for (int digits = 6;; ++digits) {
        const double number = std::strtod(fmt::format("{:.{}g}", written, digits).c_str(), nullptr);
        if (readBack(float(number)) == value || digits == 9) return Json(number);
    }
}
Json numberJson(float value) { return numberJson(value, value, [](float read) { return read; }); }

Json vectorJson(const glm::vec3& v) {
    Json array = Json::array();
    for (int i = 0; i < 3; ++i) array.push(numberJson(v[i]));
    return array;
}

/// Stands elsewhere and looks the same way.
CameraKey shifted(CameraKey camera, const glm::vec3& by) {
    camera.position += by;
    camera.target += by;
    return camera;
}

}  // namespace

CameraKey orbited(const CameraKey& camera, float right, float up) {
    constexpr float least = 0.02f;  // radians between view and `up`
    CameraKey moved = camera;
    const glm::vec3 pole = glm::normalize(camera.up);
    const glm::mat3 turn(glm::rotate(glm::mat4(1), right, pole));
    glm::vec3 back = turn * (camera.position - camera.target);
    const glm::vec3 side = turn * viewAxes(camera).right;
    const float angle = std::acos(std::clamp(glm::dot(glm::normalize(back), pole), -1.0f, 1.0f));
    const float tilt = std::clamp(angle - up, least, glm::pi<float>() - least) - angle;
    back = glm::mat3(glm::rotate(glm::mat4(1), tilt, side)) * back;
    moved.position = camera.target + back;
    return moved;
}

CameraKey turned(const CameraKey& camera, float right, float up) {
    // The target goes around the camera as the camera goes around the target; what is to the right of one is to the left of the other.
    CameraKey moved = camera;
    std::swap(moved.position, moved.target);
    moved = orbited(moved, -right, up);
    std::swap(moved.position, moved.target);
    return moved;
}

CameraKey flown(const CameraKey& camera, const glm::vec3& way) {
    const ViewAxes axes = viewAxes(camera);
    const glm::vec3 shift =
        glm::length(camera.target - camera.position) * (way.x * axes.right + way.y * glm::normalize(camera.up) + way.z * axes.forward);
    return shifted(camera, shift);
}

CameraKey panned(const CameraKey& camera, float right, float up) {
    const ViewAxes axes = viewAxes(camera);
    const glm::vec3 shift = heightAtTarget(camera) * (right * axes.right + up * axes.up);
    return shifted(camera, shift);
}

CameraKey dollied(const CameraKey& camera, float factor) {
    CameraKey moved = camera;
    if (camera.height > 0) {  // nothing grows by going nearer
        moved.height = std::clamp(camera.height * factor, nearest, farthest);
        return moved;
    }
    const float distance = glm::length(camera.position - camera.target), wanted = std::clamp(distance * factor, nearest, farthest);
    moved.position = camera.target + (camera.position - camera.target) * (wanted / distance);
    moved.focus = std::max(camera.focus + wanted - distance, nearest);
    return moved;
}

CameraKey framed(const CameraKey& camera, const std::array<glm::vec3, 2>& bounds, float aspect) {
    if (bounds[0].x > bounds[1].x) return camera;
    const float radius = std::max(0.5f * glm::length(bounds[1] - bounds[0]), nearest);
    const float half = std::atan(std::tan(0.5f * camera.fovy) * std::min(aspect, 1.0f));
    CameraKey moved = camera;
    moved.target = 0.5f * (bounds[0] + bounds[1]);
    const float distance = camera.height > 0 ? 2 * radius : radius / std::sin(half);
    if (camera.height > 0) moved.height = 2 * radius / std::min(aspect, 1.0f);
    moved.position = moved.target - viewAxes(camera).forward * distance;
    moved.focus = glm::length(moved.position - moved.target);
    return moved;
}

ViewRay viewRay(const CameraKey& camera, glm::vec2 place, float aspect) {
    const Projection picture(camera, aspect);
    if (!picture.orthographic) return {picture.base, picture.axes * glm::vec3(place, 1)};
    return {picture.base + picture.axes * glm::vec3(place, 0), picture.axes[2]};
}

glm::vec3 placeInPicture(const CameraKey& camera, const glm::vec3& point, float aspect) {
    const Projection projection(camera, aspect);
    const glm::vec3 place = glm::inverse(projection.axes) * (point - projection.base);
    return projection.orthographic ? glm::vec3(place.x, place.y, 1) : place;
}

std::optional<glm::vec2> placeOf(const CameraKey& camera, const glm::vec3& point, float aspect) {
    const glm::vec3 place = placeInPicture(camera, point, aspect);
    return place.z > 0 ? std::optional(glm::vec2(place) / place.z) : std::nullopt;
}

Json cameraJson(const CameraKey& camera) {
    Json json = Json::object();
    json["position"] = vectorJson(camera.position);
    json["target"] = vectorJson(camera.target);
    json["up"] = vectorJson(camera.up);
    if (camera.height > 0) {
        json["orthographic"] = numberJson(camera.height);
    } else {
        json["fovy"] = numberJson(camera.fovy, glm::degrees(camera.fovy), [](float read) { return glm::radians(read); });
        json["aperture"] = numberJson(camera.aperture);
    }
    json["focus"] = numberJson(camera.focus);
    return json;
}

glm::mat3 warpBetween(const CameraKey& from, const CameraKey& to, float aspect) {
    const glm::vec3 normal = viewAxes(from).forward;
    const Projection source(from, aspect), target(to, aspect);
    // Where the ray of a place q in the picture `to` meets the plane n.(P - T) = 0, times a weight: `point` q and dot(weight, q), linear in q.
    glm::mat3 point;
    glm::vec3 weight;
    if (target.orthographic) {
        const float facing = glm::dot(normal, target.axes[2]);
        const glm::mat3 origins(target.axes[0], target.axes[1], target.base);
        weight = {0, 0, facing};
        point = facing * origins - glm::outerProduct(target.axes[2], normal * origins);
        point[2] += target.axes[2] * glm::dot(normal, from.target);
    } else {
        weight = normal * target.axes;
        point = glm::outerProduct(target.base, weight) + glm::dot(normal, from.target - target.base) * target.axes;
    }
    // And the place where the picture `from` has it.
    glm::mat3 place = glm::inverse(source.axes) * (point - glm::outerProduct(source.base, weight));
    if (source.orthographic)
        for (int i = 0; i < 3; ++i) place[i].z = weight[i];
    return place;
}

}  // namespace lodestir
