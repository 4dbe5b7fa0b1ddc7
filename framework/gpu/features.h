// SPDX-License-Identifier: MIT
// What the framework asks of a device: one table, read for `lodestir devices`, for choosing, and for switching features on.
#pragma once
#include <framework/gpu/device.h>

#include <set>
#include <string>
#include <vector>

namespace lodestir::gpu {

/// The feature structures of Vulkan 1.3 and of the optional extensions, linked for a query or for vkCreateDevice.
struct FeatureChain {
    VkPhysicalDeviceFeatures2 core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, nullptr, {}};
    VkPhysicalDeviceVulkan11Features v11{};
    VkPhysicalDeviceVulkan12Features v12{};
    VkPhysicalDeviceVulkan13Features v13{};
    VkPhysicalDeviceShaderAtomicFloatFeaturesEXT atomicFloat{};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR acceleration{};
    VkPhysicalDeviceRayQueryFeaturesKHR rayQuery{};

    FeatureChain();
    FeatureChain(const FeatureChain&) = delete;
    FeatureChain& operator=(const FeatureChain&) = delete;
    /// Links the structures that a device with these extensions knows; returns the head.
    VkPhysicalDeviceFeatures2* link(const std::set<std::string>& extensions);
};

/// Names of the extensions that a device has.
std::set<std::string> deviceExtensions(VkPhysicalDevice physical);
/// Everything about a device that the framework looks at.
DeviceFacts describeDevice(VkPhysicalDevice physical, int index);
/// Sets in `chain` what is needed or can be used, and returns the extensions to switch on with it.
std::vector<const char*> enableFeatures(VkPhysicalDevice physical, bool window, FeatureChain& chain);
/// The queue family that work goes to: computes, and draws as well where such a one exists. Negative when no family computes.
int findQueueFamily(VkPhysicalDevice physical);

}  // namespace lodestir::gpu
