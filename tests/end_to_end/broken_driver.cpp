// SPDX-License-Identifier: MIT
// A Vulkan driver that crashes, or never answers, when it is first asked for something (BROKEN_DRIVER=crash, hang).
#include <vulkan/vulkan.h>

#include <csignal>
#include <cstdlib>
#include <string_view>

#include <unistd.h>

#define EXPORTED extern "C" __attribute__((visibility("default")))

namespace {

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo*, const VkAllocationCallbacks*, VkInstance*) {
    const char* how = std::getenv("BROKEN_DRIVER");
    if (how && std::string_view(how) == "crash") std::raise(SIGSEGV);
    for (;;) ::pause();
}

VKAPI_ATTR VkResult VKAPI_CALL extensions(const char*, std::uint32_t* count, VkExtensionProperties*) {
    *count = 0;
    return VK_SUCCESS;
}

}  // namespace

EXPORTED VKAPI_ATTR VkResult VKAPI_CALL vk_icdNegotiateLoaderICDInterfaceVersion(std::uint32_t*) { return VK_SUCCESS; }

EXPORTED VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vk_icdGetInstanceProcAddr(VkInstance, const char* name) {
    if (std::string_view(name) == "vkCreateInstance") return reinterpret_cast<PFN_vkVoidFunction>(createInstance);
    if (std::string_view(name) == "vkEnumerateInstanceExtensionProperties") return reinterpret_cast<PFN_vkVoidFunction>(extensions);
    return nullptr;
}
