// SPDX-License-Identifier: MIT
// The images of a window that take turns on the screen.
#pragma once
#include <framework/app/view/window.h>
#include <framework/gpu/device.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace lodestir {

class Swapchain {
public:
    /// Error when the device can't present to the window.
    Swapchain(const gpu::Device& device, const Window& window);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    struct Image {
        VkImage image = VK_NULL_HANDLE;
        VkImageView view = VK_NULL_HANDLE;
        VkFramebuffer framebuffer = VK_NULL_HANDLE;
        VkSemaphore drawn = VK_NULL_HANDLE;  ///< to be signalled by what draws it
    };
    /// The next image, free when `acquired()` is signalled; nullptr while there is none (minimised). Follows the window's size.
    const Image* acquire();
    VkSemaphore acquired() const { return acquired_; }
    void present(const Image& image);

    VkRenderPass renderPass() const { return renderPass_; }  ///< keeps what is there, leaves it ready to be presented
    std::uint32_t imageCount() const { return std::uint32_t(images_.size()); }
    glm::uvec2 extent() const { return {extent_.width, extent_.height}; }
    bool blueFirst() const { return format_ == VK_FORMAT_B8G8R8A8_UNORM; }  ///< order of the bytes of a pixel

private:
    void make();
    void drop();

    const gpu::Device& device_;
    const Window& window_;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkRenderPass renderPass_ = VK_NULL_HANDLE;
    VkSemaphore acquired_ = VK_NULL_HANDLE;
    VkFormat format_ = VK_FORMAT_UNDEFINED;
    VkColorSpaceKHR colorSpace_{};
    VkExtent2D extent_{};
    std::vector<Image> images_;
    bool outdated_ = true;
};

}  // namespace lodestir
