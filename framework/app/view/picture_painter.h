// SPDX-License-Identifier: MIT
// Puts a captured port into a rectangle of the window: zoomed, coloured, and asked for the value under the pointer.
#pragma once
#include <framework/app/view/view_state.h>
#include <framework/gpu/commands.h>
#include <framework/gpu/pipeline.h>

#include <array>
#include <optional>

namespace lodestir {

/// How numbers become colour.
struct Look {
    std::uint32_t look = LOOK_COLOR, pick = 0, curve = 0;  ///< see view/picture.h
    float exposure = 0;                                    ///< stops
    float low = 0, high = 1;
};

/// A rectangle of the window: in points for panels and pointer, in pixels for what draws.
struct Rectangle {
    glm::ivec2 corner{0}, size{0};
    bool operator==(const Rectangle&) const = default;
    /// In pixels, of one in points that are so many pixels each.
    Rectangle inPixels(float density) const { return {glm::ivec2(density * glm::vec2(corner)), glm::ivec2(density * glm::vec2(size))}; }
};

class PicturePainter {
public:
    explicit PicturePainter(const gpu::Device& device);

    /// Records the drawing of a picture, or of how far its numbers are from another's of the same extent and layout (`minus`, may be null). `toImage`: from
    /// pixels of the rectangle to pixels of the image. `probe`: the pixel whose value is wanted.
    void prepare(gpu::Commands& commands, const Picture& picture, const Picture* minus, const TexelLayout& layout, const Look& look, const Rectangle& place,
                 const glm::mat3& toImage, glm::ivec2 probe, bool blueFirst);
    /// Copies what was prepared last, from one share of the rectangle's width to another; does nothing before.
    void paint(gpu::Commands& commands, VkImage image, float from = 0, float to = 1) const;

    struct Probe {
        glm::ivec2 pixel;
        std::array<std::uint32_t, 4> bits;
        TexelLayout layout;
    };
    /// What was found where it was last asked for; valid when those commands have finished.
    std::optional<Probe> probe() const;

private:
    const gpu::Device& device_;
    gpu::Pipeline color_, placement_;
    gpu::Buffer ramp_, colors_, target_, probe_;
    Rectangle place_;
    Picture picture_, minus_;  ///< keep their memory while they are drawn
    ColorTexels colored_{};
    PlacePicture placed_{};
    TexelLayout layout_;
};

}  // namespace lodestir
