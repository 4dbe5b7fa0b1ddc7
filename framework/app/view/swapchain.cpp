// SPDX-License-Identifier: MIT
#include <framework/app/view/swapchain.h>

#include <framework/core/error.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

namespace lodestir {

using gpu::check;

Swapchain::Swapchain(const gpu::Device& device, const Window& window) : device_(device), window_(window) {
    check(glfwCreateWindowSurface(device.instance(), window.handle(), nullptr, &surface_), "glfwCreateWindowSurface");
    VkBool32 can = VK_FALSE;
    check(vkGetPhysicalDeviceSurfaceSupportKHR(device.physical(), device.queueFamily(), surface_, &can), "vkGetPhysicalDeviceSurfaceSupportKHR");
    std::uint32_t count = 0;
    check(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical(), surface_, &count, nullptr), "vkGetPhysicalDeviceSurfaceFormatsKHR");
    std::vector<VkSurfaceFormatKHR> formats(count);
    check(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical(), surface_, &count, formats.data()), "vkGetPhysicalDeviceSurfaceFormatsKHR");
    const auto found =
        std::ranges::find_if(formats, [](const VkSurfaceFormatKHR& f) { return f.format == VK_FORMAT_B8G8R8A8_UNORM || f.format == VK_FORMAT_R8G8B8A8_UNORM; });
    if (!can || found == formats.end()) {
        vkDestroySurfaceKHR(device.instance(), surface_, nullptr);
        throw Error("device \"" + device.facts().name + "\" can't draw into this window", "choose another with --device, see `lodestir devices`");
    }
    format_ = found->format;
    colorSpace_ = found->colorSpace;

    VkAttachmentDescription color{};
    color.format = format_;
    color.samples = VK_SAMPLE_COUNT_1_BIT;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    color.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    color.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1;
    info.pAttachments = &color;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    check(vkCreateRenderPass(device.handle(), &info, nullptr, &renderPass_), "vkCreateRenderPass");
    VkSemaphoreCreateInfo semaphore{};
    semaphore.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    check(vkCreateSemaphore(device.handle(), &semaphore, nullptr, &acquired_), "vkCreateSemaphore");
    make();
}

Swapchain::~Swapchain() {
    device_.waitIdle();
    drop();
    vkDestroySwapchainKHR(device_.handle(), swapchain_, nullptr);
    vkDestroySemaphore(device_.handle(), acquired_, nullptr);
    vkDestroyRenderPass(device_.handle(), renderPass_, nullptr);
    vkDestroySurfaceKHR(device_.instance(), surface_, nullptr);
}

void Swapchain::drop() {
    for (const Image& image : images_) {
        vkDestroyFramebuffer(device_.handle(), image.framebuffer, nullptr);
        vkDestroyImageView(device_.handle(), image.view, nullptr);
        vkDestroySemaphore(device_.handle(), image.drawn, nullptr);
    }
    images_.clear();
}

void Swapchain::make() {
    VkSurfaceCapabilitiesKHR can{};
    check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical(), surface_, &can), "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    const glm::ivec2 size = window_.size();
    extent_ = can.currentExtent.width != ~0u ? can.currentExtent
                                             : VkExtent2D{std::clamp(std::uint32_t(size.x), can.minImageExtent.width, can.maxImageExtent.width),
                                                          std::clamp(std::uint32_t(size.y), can.minImageExtent.height, can.maxImageExtent.height)};
    if (extent_.width == 0 || extent_.height == 0) return;
    device_.waitIdle();
    drop();
    const VkSwapchainKHR old = swapchain_;
    VkSwapchainCreateInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
    info.surface = surface_;
    info.minImageCount = std::max(can.minImageCount, can.maxImageCount == 0 ? 3u : std::min(3u, can.maxImageCount));
    info.imageFormat = format_;
    info.imageColorSpace = colorSpace_;
    info.imageExtent = extent_;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.preTransform = can.currentTransform;
    info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    info.clipped = VK_TRUE;
    info.oldSwapchain = old;
    check(vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &swapchain_), "vkCreateSwapchainKHR");
    vkDestroySwapchainKHR(device_.handle(), old, nullptr);

    std::uint32_t count = 0;
    check(vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, nullptr), "vkGetSwapchainImagesKHR");
    std::vector<VkImage> handles(count);
    check(vkGetSwapchainImagesKHR(device_.handle(), swapchain_, &count, handles.data()), "vkGetSwapchainImagesKHR");
    for (VkImage handle : handles) {
        Image& image = images_.emplace_back(Image{.image = handle});
        VkImageViewCreateInfo view{};
        view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        view.image = handle;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = format_;
        view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        check(vkCreateImageView(device_.handle(), &view, nullptr, &image.view), "vkCreateImageView");
        VkFramebufferCreateInfo framebuffer{};
        framebuffer.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
        framebuffer.renderPass = renderPass_;
        framebuffer.attachmentCount = 1;
        framebuffer.pAttachments = &image.view;
        framebuffer.width = extent_.width;
        framebuffer.height = extent_.height;
        framebuffer.layers = 1;
        check(vkCreateFramebuffer(device_.handle(), &framebuffer, nullptr, &image.framebuffer), "vkCreateFramebuffer");
        VkSemaphoreCreateInfo semaphore{};
        semaphore.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
        check(vkCreateSemaphore(device_.handle(), &semaphore, nullptr, &image.drawn), "vkCreateSemaphore");
    }
    outdated_ = false;
}

const Swapchain::Image* Swapchain::acquire() {
    for (int attempt = 0; attempt < 3; ++attempt) {
        const glm::ivec2 size = window_.size();
        if (size.x == 0 || size.y == 0) return nullptr;
        if (outdated_ || extent_.width != std::uint32_t(size.x) || extent_.height != std::uint32_t(size.y)) make();
        if (images_.empty()) return nullptr;
        std::uint32_t index = 0;
        const VkResult result = vkAcquireNextImageKHR(device_.handle(), swapchain_, UINT64_MAX, acquired_, VK_NULL_HANDLE, &index);
        if (result == VK_ERROR_OUT_OF_DATE_KHR) {
            outdated_ = true;
            continue;
        }
        if (result != VK_SUBOPTIMAL_KHR) check(result, "vkAcquireNextImageKHR");
        return &images_[index];
    }
    return nullptr;
}

void Swapchain::present(const Image& image) {
    const auto index = std::uint32_t(&image - images_.data());
    VkPresentInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &image.drawn;
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain_;
    info.pImageIndices = &index;
    const auto lock = device_.lockQueue();
    const VkResult result = vkQueuePresentKHR(device_.queue(), &info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) outdated_ = true;
    else check(result, "vkQueuePresentKHR");
}

}  // namespace lodestir
