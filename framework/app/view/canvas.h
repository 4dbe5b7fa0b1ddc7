// SPDX-License-Identifier: MIT
// Draws a window: first the picture, then Dear ImGui's panels over it.
#pragma once
#include <framework/app/view/swapchain.h>
#include <framework/core/files.h>
#include <framework/gpu/buffer.h>
#include <framework/gpu/commands.h>

#include <functional>
#include <memory>

struct ImFont;

namespace lodestir {

class Canvas {
public:
    Canvas(const gpu::Device& device, const Window& window);
    ~Canvas();
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    /// Waits for the last drawing and starts the next; false where there is nothing to draw on.
    bool begin();
    /// `prepare` records work that comes before the image is touched, `paint` copies into the image (in the layout TRANSFER_DST). Returns when
    /// the image is handed to the screen. `screenshot`: a PNG of it all is written there, empty: none.
    void end(const std::function<void(gpu::Commands&)>& prepare, const std::function<void(gpu::Commands&, VkImage)>& paint, const Path& screenshot);
    void wait() { commands_.wait(); }  ///< until what end() recorded is drawn
    bool blueFirst() const { return swapchain_.blueFirst(); }
    glm::uvec2 extent() const { return swapchain_.extent(); }
    /// What panels are laid out in and the pointer is told in: points, each of density() pixels.
    glm::uvec2 points() const { return glm::vec2(extent()) / density_; }
    float density() const { return density_; }

private:
    void writeScreenshot(const gpu::Buffer& memory, const Path& file) const;

    const gpu::Device& device_;
    const float density_;
    Swapchain swapchain_;
    gpu::Commands commands_;
    VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
    const Swapchain::Image* image_ = nullptr;
};

}  // namespace lodestir
