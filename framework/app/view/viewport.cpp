// SPDX-License-Identifier: MIT
#include <framework/app/view/viewport.h>

#include <framework/app/view/orbit_camera.h>

#include <imgui/imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lodestir {

namespace {

/// In distances to the target, since the last drawing: what the keys that are held mean.
glm::vec3 flight(const ImGuiIO& io) {
    if (io.WantTextInput || io.KeyCtrl) return glm::vec3(0);
    const auto held = [](ImGuiKey key) { return ImGui::IsKeyDown(ImGui::GetKeyIndex(key)) ? 1.0f : 0.0f; };
    const glm::vec3 way(held(ImGuiKey_RightArrow) - held(ImGuiKey_LeftArrow), held(ImGuiKey_PageUp) - held(ImGuiKey_PageDown),
                        held(ImGuiKey_UpArrow) - held(ImGuiKey_DownArrow));
    constexpr float aSecond = 0.5f, longest = 0.1f;  // the first key comes long after the last drawing
    return (io.KeyShift ? 4 : 1) * aSecond * std::min(io.DeltaTime, longest) * way;
}

}  // namespace

std::optional<CameraKey> Viewport::interact(const Rectangle& place, glm::uvec2 extent, const CameraState& camera) {
    place_ = place;
    if (extent.x > 0) extent_ = extent;
    if (extent_.x == 0 || place.size.x <= 0 || place.size.y <= 0) return {};
    const ImGuiIO& io = ImGui::GetIO();
    const glm::vec2 size(place.size), image(extent_);
    if (zoom_ <= 0) {
        scale_ = std::min(size.x / image.x, size.y / image.y);
        // Whole pixels stay square and alike.
        if (const float density = io.DisplayFramebufferScale.x; density * scale_ > 1 && !fills_) scale_ = std::floor(density * scale_) / density;
        centre_ = 0.5f * image;
    } else {
        scale_ = zoom_;
    }

    const glm::vec2 pointer = glm::vec2(io.MousePos.x, io.MousePos.y) - glm::vec2(place.corner);
    const bool inside = pointer.x >= 0 && pointer.y >= 0 && pointer.x < size.x && pointer.y < size.y;
    const bool free = inside && !io.WantCaptureMouse;
    if (button_ >= 0 && !io.MouseDown[button_]) {
        if (button_ == 0 && dragged_ < 3 && inside && !movesPicture_) clicked_ = pointer;
        button_ = -1;
    }
    for (int button = 0; button < 3 && button_ < 0; ++button)
        if (free && ImGui::IsMouseClicked(button)) {
            button_ = button;
            movesPicture_ = io.KeyCtrl;
            looksAround_ = io.KeyShift;
            dragged_ = 0;
        }
    const glm::vec2 drag = button_ >= 0 ? glm::vec2(io.MouseDelta.x, io.MouseDelta.y) : glm::vec2(0);

    dragged_ += std::abs(drag.x) + std::abs(drag.y);

    std::optional<CameraKey> result;
    const CameraKey now = moved_.value_or(camera.key);
    if (drag != glm::vec2(0)) {
        const glm::vec2 part = drag / (image.y * scale_);
        if (movesPicture_) {
            zoom_ = scale_;
            centre_ -= drag / scale_;
        } else if (button_ == 0 && looksAround_) {
            const float angle = now.height > 0 ? 1.0f : now.fovy;  // what is far stays under the pointer
            result = turned(now, -angle * part.x, angle * part.y);
        } else if (button_ == 0) {
            result = orbited(now, -3.14159265f * part.x, 3.14159265f * part.y);
        } else {
            result = panned(now, -part.x, part.y);
        }
    }
    if (const glm::vec3 way = flight(io); way != glm::vec3(0)) result = flown(result.value_or(now), way);
    if (free && io.MouseWheel != 0) {
        if (io.KeyCtrl) {
            const glm::vec2 held = imagePlace(pointer);
            zoom_ = scale_ = std::clamp(scale_ * std::exp2(0.5f * io.MouseWheel), 1 / 16.0f, 64.0f);
            centre_ += held - imagePlace(pointer);
        } else {
            result = dollied(result.value_or(now), std::pow(0.88f, io.MouseWheel));
        }
    }
    const glm::vec2 at = glm::floor(imagePlace(pointer));
    pixel_ = inside && at.x >= 0 && at.y >= 0 && at.x < image.x && at.y < image.y ? glm::ivec2(at) : glm::ivec2(-1);
    if (result) moved_ = result;
    return result;
}

void Viewport::zoomTo(float zoom) { zoom_ = zoom; }

std::optional<glm::vec2> Viewport::takeClick(const Picture& picture) {
    const auto clicked = std::exchange(clicked_, std::nullopt);
    if (!clicked || picture.extent.x == 0) return std::nullopt;
    const glm::vec3 pixel = toImage(picture) * glm::vec3(*clicked, 1);
    const glm::vec2 place = glm::vec2(pixel) / pixel.z / glm::vec2(picture.extent);
    const bool inside = pixel.z > 0 && glm::all(glm::greaterThanEqual(place, glm::vec2(0))) && glm::all(glm::lessThan(place, glm::vec2(1)));
    return inside ? std::optional(place) : std::nullopt;
}

glm::mat3 Viewport::toImage(const Picture& picture) const {
    const glm::vec2 corner = centre_ - 0.5f * glm::vec2(place_.size) / scale_, image(picture.extent);
    const glm::mat3 zoom(1 / scale_, 0, 0, 0, 1 / scale_, 0, corner.x, corner.y, 1);
    if (!moved_) return zoom;
    const glm::mat3 shrink(1 / image.x, 0, 0, 0, 1 / image.y, 0, 0, 0, 1), grow(image.x, 0, 0, 0, image.y, 0, 0, 0, 1);
    const glm::mat3 warp = warpBetween(picture.camera, *moved_, image.x / image.y);
    // The same camera gives the identity but for rounding, which would make whole pixels ragged.
    const glm::mat3 relative = warp / warp[2][2];
    bool same = true;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) same = same && std::abs(relative[c][r] - (c == r ? 1.0f : 0.0f)) < 1e-4f;
    return same ? zoom : grow * warp * shrink * zoom;
}

}  // namespace lodestir
