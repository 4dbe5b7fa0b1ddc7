// SPDX-License-Identifier: MIT
#include <framework/app/view/canvas.h>

#include <framework/app/view/theme.h>
#include <framework/core/log.h>
#include <framework/image/png.h>
#include <framework/image/srgb.h>

#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_vulkan.h>
#include <imgui/imgui.h>

namespace lodestir {
namespace {

void changeLayout(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to) {
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace

Canvas::Canvas(const gpu::Device& device, const Window& window)
    : device_(device), density_(window.density()), swapchain_(device, window), commands_(device, 0) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // the layout is fixed
    ImGui::GetIO().LogFilename = nullptr;
    setTheme(density_);
    ImGui_ImplGlfw_InitForVulkan(window.handle(), true);

    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4};
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    pool.maxSets = 4;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    gpu::check(vkCreateDescriptorPool(device.handle(), &pool, nullptr, &descriptors_), "vkCreateDescriptorPool");
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = device.instance();
    info.PhysicalDevice = device.physical();
    info.Device = device.handle();
    info.QueueFamily = device.queueFamily();
    info.Queue = device.queue();
    info.DescriptorPool = descriptors_;
    info.MinImageCount = 2;
    info.ImageCount = std::max(2u, swapchain_.imageCount());
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    info.CheckVkResultFn = [](VkResult result) { gpu::check(result, "Dear ImGui"); };
    ImGui_ImplVulkan_Init(&info, swapchain_.renderPass());
    gpu::runOnce(device, [](gpu::Commands& commands) { ImGui_ImplVulkan_CreateFontsTexture(commands.handle()); });
    ImGui_ImplVulkan_DestroyFontUploadObjects();
}

Canvas::~Canvas() {
    device_.waitIdle();
    ImGui_ImplVulkan_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    vkDestroyDescriptorPool(device_.handle(), descriptors_, nullptr);
}

bool Canvas::begin() {
    commands_.wait();
    image_ = swapchain_.acquire();
    if (!image_) return false;
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    // It speaks of the desktop's units, which are pixels in one place (X11) and points in another (Wayland).
    ImGuiIO& io = ImGui::GetIO();
    const glm::vec2 toPoints = glm::vec2(io.DisplayFramebufferScale.x, io.DisplayFramebufferScale.y) / density_;
    io.MousePos = {toPoints.x * io.MousePos.x, toPoints.y * io.MousePos.y};
    io.DisplaySize = {float(points().x), float(points().y)};
    io.DisplayFramebufferScale = {density_, density_};
    ImGui::NewFrame();
    return true;
}

void Canvas::end(const std::function<void(gpu::Commands&)>& prepare, const std::function<void(gpu::Commands&, VkImage)>& paint, const Path& screenshot) {
    ImGui::Render();
    commands_.begin();
    prepare(commands_);
    commands_.barrier();
    const VkCommandBuffer handle = commands_.handle();
    changeLayout(handle, image_->image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    VkClearColorValue clear{};
    const std::array<float, 3> background = backgroundColor();
    std::copy(background.begin(), background.end(), clear.float32);
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdClearColorImage(handle, image_->image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &clear, 1, &all);
    commands_.barrier();
    paint(commands_, image_->image);
    changeLayout(handle, image_->image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);

    VkRenderPassBeginInfo pass{};
    pass.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    pass.renderPass = swapchain_.renderPass();
    pass.framebuffer = image_->framebuffer;
    pass.renderArea.extent = {extent().x, extent().y};
    vkCmdBeginRenderPass(handle, &pass, VK_SUBPASS_CONTENTS_INLINE);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), handle);
    vkCmdEndRenderPass(handle);

    gpu::Buffer shot;
    if (!screenshot.empty()) {
        shot = gpu::Buffer(device_, std::size_t(extent().x) * extent().y * 4, gpu::Memory::readback, "screenshot");
        changeLayout(handle, image_->image, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        VkBufferImageCopy region{};
        region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        region.imageExtent = {extent().x, extent().y, 1};
        vkCmdCopyImageToBuffer(handle, image_->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, shot.handle(), 1, &region);
        changeLayout(handle, image_->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
    }
    commands_.submit(swapchain_.acquired(), image_->drawn);
    swapchain_.present(*image_);
    image_ = nullptr;
    if (screenshot.empty()) return;
    commands_.wait();
    writeScreenshot(shot, screenshot);
}

void Canvas::writeScreenshot(const gpu::Buffer& memory, const Path& file) const {
    std::array<float, 256> linear;
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = decodeSrgb(float(i) / 255.0f);
    ImageData image = makeImage(int(extent().x), int(extent().y), 3);
    for (std::size_t i = 0; i < image.pixelCount(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            image.values[3 * i + c] = linear[std::to_integer<std::size_t>(memory.mapped()[4 * i + (swapchain_.blueFirst() ? 2 - c : c)])];
    writePng(file, image);
    log::note("wrote {}", file.string());
}

}  // namespace lodestir
