// SPDX-License-Identifier: MIT
// The implementation unit of VulkanMemoryAllocator; its own warnings are not ours.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wimplicit-fallthrough"
#pragma GCC diagnostic ignored "-Wparentheses"
#pragma GCC diagnostic ignored "-Wtype-limits"
#define VMA_IMPLEMENTATION
#include <framework/gpu/memory.h>
#pragma GCC diagnostic pop

#include <framework/gpu/device.h>

namespace lodestir::gpu {

VmaAllocator createAllocator(VkInstance instance, VkPhysicalDevice physical, VkDevice device) {
    VmaAllocatorCreateInfo info{};
    info.flags = VMA_ALLOCATOR_CREATE_BUFFER_DEVICE_ADDRESS_BIT;
    info.instance = instance;
    info.physicalDevice = physical;
    info.device = device;
    info.vulkanApiVersion = VK_API_VERSION_1_3;
    VmaAllocator allocator = VK_NULL_HANDLE;
    check(vmaCreateAllocator(&info, &allocator), "vmaCreateAllocator");
    return allocator;
}

}  // namespace lodestir::gpu
