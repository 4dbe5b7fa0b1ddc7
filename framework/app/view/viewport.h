// SPDX-License-Identifier: MIT
// The part of the window that shows the picture: zoom and place of the picture, and the camera that the mouse moves.
#pragma once
#include <framework/app/view/picture_painter.h>

#include <optional>

namespace lodestir {

class Viewport {
public:
    /// Takes the mouse and the keys of this UI frame. `camera`: where the scene is seen from, as far as the renderer has said.
    /// Returns the camera when it was moved.
    std::optional<CameraKey> interact(const Rectangle& place, glm::uvec2 extent, const CameraState& camera);
    /// The camera is the viewer's from now on, e.g. because the panel changed its lens; or (nothing) the scene's again.
    void setCamera(const std::optional<CameraKey>& camera) { moved_ = camera; }
    const std::optional<CameraKey>& camera() const { return moved_; }

    void fit() { zoom_ = 0; }
    void fill(bool fills) { fills_ = fills; }  ///< what fits is as large as the place, be pixels of the image whole ones of the window or not
    void zoomTo(float zoom);  ///< points of the window a pixel of the image, about the middle
    float zoom() const { return scale_; }
    /// From points of the rectangle to pixels of the image: a picture of an older camera is warped to where the camera is by now.
    glm::mat3 toImage(const Picture& picture) const;
    /// In points of the window, of a place in the picture that the camera sees by now: 0..1 to the right and downwards.
    glm::vec2 inWindow(glm::vec2 place) const {
        return glm::vec2(place_.corner) + 0.5f * glm::vec2(place_.size) + scale_ * (place * glm::vec2(extent_) - centre_);
    }
    /// Where in the image a left click was that moved nothing, once; `picture`: what was seen there.
    std::optional<glm::vec2> takeClick(const Picture& picture);
    glm::ivec2 pixelUnderPointer() const { return pixel_; }  ///< {-1, -1}: none

private:
    glm::vec2 imagePlace(glm::vec2 pointer) const { return centre_ + (pointer - 0.5f * glm::vec2(place_.size)) / scale_; }

    Rectangle place_;
    glm::uvec2 extent_{0};
    float zoom_ = 0, scale_ = 1;  ///< zoom 0: as large as fits
    glm::vec2 centre_{0};         ///< pixel of the image in the middle of the rectangle
    glm::ivec2 pixel_{-1};
    int button_ = -1;             ///< that was pressed inside and is held
    bool movesPicture_ = false, looksAround_ = false, fills_ = false;
    float dragged_ = 0;           ///< points, while a button is held
    std::optional<glm::vec2> clicked_;  ///< point of the rectangle
    std::optional<CameraKey> moved_;
};

}  // namespace lodestir
