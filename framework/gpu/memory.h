// SPDX-License-Identifier: MIT
// The allocator that all buffers of a device share (VulkanMemoryAllocator, whose implementation is compiled in memory.cpp).
#pragma once
#include <vulkan/vulkan.h>
#include <vk_mem_alloc.h>

namespace lodestir::gpu {

/// Allocator for memory that shaders reach by address. Error when it can't be made. Destroy with vmaDestroyAllocator.
VmaAllocator createAllocator(VkInstance instance, VkPhysicalDevice physical, VkDevice device);

}  // namespace lodestir::gpu
