// SPDX-License-Identifier: MIT
// The Vulkan instance, physical device, logical device and queue that everything runs on.
#pragma once
#include <framework/core/api.h>

#include <vulkan/vulkan.h>
#include <vk_mem_alloc.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace lodestir::gpu {

class Heap;
class PipelineCache;

/// One feature that the framework needs or can use, for `lodestir devices`.
struct Feature {
    std::string name;      ///< Vulkan's own name, e.g. "bufferDeviceAddress"
    bool required = false;
    bool present = false;
    std::string fallback;  ///< what is done without it (optional features)
};

struct DeviceFacts {
    int index = 0;
    std::string name, driver, driverVersion, apiVersion, type;  ///< type: "cpu", "discrete", "integrated", "virtual", "other"
    std::uint32_t subgroupSize = 0;
    std::uint64_t memoryBytes = 0;
    bool isLavapipe = false;
    bool rayQuery = false;
    bool pinsSubgroupSize = false;  ///< pipelines can be held to subgroupSize lanes
    bool readsTexels = false;    ///< records are read by texel rather than by address, see gpu/heap.h
    bool unifiedMemory = false;  ///< all memory is the CPU's own: buffers are filled and read in place
    float timestampPeriod = 1;  ///< nanoseconds a tick
    std::uint32_t timestampBits = 0;   ///< valid bits of a stamp; 0: the queue has no timestamps
    std::uint32_t maxGroups[3] = {};   ///< workgroups of one dispatch, per axis
    std::uint32_t maxPushBytes = 0;    ///< size of the push-constant block
    std::uint64_t maxBufferBytes = 0;  ///< size of one buffer
    std::vector<Feature> features;
    bool usable() const;
};

struct DeviceOptions {
    std::string choice;       ///< index, or part of a name (case-insensitive); empty: the first usable discrete, then integrated, then CPU
    std::optional<bool> validation;  ///< unset: on when the environment has LODESTIR_VALIDATION=1
    std::vector<std::string> windowExtensions;  ///< instance extensions that a window needs; not empty: VK_KHR_swapchain is on, too
};

/// Lists all physical devices, usable or not; none where there is no Vulkan driver.
LODESTIR_API std::vector<DeviceFacts> listDevices();
/// Index into `devices` of the one that `choice` means (see DeviceOptions). Error naming each device and what it lacks when none fits.
LODESTIR_API std::size_t chooseDevice(const std::vector<DeviceFacts>& devices, const std::string& choice);
/// Why that one, as the end of a sentence.
LODESTIR_API std::string whyDevice(const std::vector<DeviceFacts>& devices, const std::string& choice);

/// Vulkan 1.3 with bufferDeviceAddress, scalarBlockLayout, shaderInt64, 8/16-bit storage, descriptorIndexing,
/// subgroup basic/vote/ballot/shuffle/arithmetic in compute, synchronization2, host query reset. The whole list: `lodestir devices`.
/// Any thread may use it; one that submits, presents or waits for the queue itself holds lockQueue() meanwhile.
class LODESTIR_API Device {
public:
    /// Error when no device fits, naming each device and the feature it lacks.
    explicit Device(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceFacts& facts() const { return facts_; }
    const std::string& reason() const { return reason_; }  ///< why this one was chosen, see whyDevice
    VkInstance instance() const { return instance_; }
    VkPhysicalDevice physical() const { return physical_; }
    VkDevice handle() const { return device_; }
    VkQueue queue() const { return queue_; }
    std::uint32_t queueFamily() const { return queueFamily_; }
    VmaAllocator allocator() const { return allocator_; }
    /// Where all buffers are to lie; nullptr for devices that read by address.
    Heap* heap() const { return heap_.get(); }
    PipelineCache& pipelines() const { return *pipelines_; }
    bool validating() const { return validating_; }
    /// Validation messages (warnings and errors) so far; each is also logged. Tests fail when it is not empty.
    const std::vector<std::string>& validationMessages() const;
    void waitIdle() const;
    /// The queue takes work of one thread at a time: Commands hold this while they submit.
    std::unique_lock<std::mutex> lockQueue() const { return std::unique_lock(queueMutex_); }

    /// Names an object, or opens and closes a region of commands, for debuggers and messages. Does nothing where no tool could see it.
    void setName(VkObjectType type, std::uint64_t handle, const std::string& name) const;
    void beginLabel(VkCommandBuffer commands, const std::string& name) const;
    void endLabel(VkCommandBuffer commands) const;

private:
    struct Messages;
    explicit Device(std::nullptr_t);  ///< holds nothing yet
    DeviceFacts facts_;
    std::string reason_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    mutable std::mutex queueMutex_;
    std::uint32_t queueFamily_ = 0;
    VmaAllocator allocator_ = VK_NULL_HANDLE;
    std::unique_ptr<Heap> heap_;
    std::unique_ptr<PipelineCache> pipelines_;
    bool validating_ = false;
    PFN_vkSetDebugUtilsObjectNameEXT setName_ = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel_ = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT endLabel_ = nullptr;
    std::unique_ptr<Messages> messages_;
};

/// Throws Error naming the call when a Vulkan call fails.
LODESTIR_API void check(VkResult result, const char* call);

}  // namespace lodestir::gpu
