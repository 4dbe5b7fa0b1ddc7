// SPDX-License-Identifier: MIT
// The one range of memory that a CPU driver's buffers lie in, which its shaders see as a texel buffer, too.
#pragma once
#include <vulkan/vulkan.h>
#include <vk_mem_alloc.h>

#include <atomic>

namespace lodestir::gpu {

class Device;

/// For a driver that reads what differs from lane to lane much faster by texel than by address (gpu/texel_reads.h). The range begins at a
/// multiple of 4 GiB, so that the lower 32 bits of an address tell the texel. Its pages take memory only once they are written.
class Heap {
public:
    /// Only where DeviceFacts::readsTexels. The device and its allocator must outlive it. Error when memory is out.
    explicit Heap(const Device& device);
    ~Heap();
    Heap(const Heap&) = delete;
    Heap& operator=(const Heap&) = delete;

    VmaPool pool() const { return pool_; }
    VkDescriptorSetLayout layout() const { return layout_; }
    VkDescriptorSet set() const { return set_; }
    /// Whether all that shaders may read lies in it. Once something does not, they have to read by address.
    bool isWhole() const { return whole_; }
    void overflow() { whole_ = false; }

private:
    void reserve();
    void makePool();
    void makeView();
    void makeSet();
    void destroy();

    const Device& device_;
    void* reserved_ = nullptr;  ///< address space around the range, so that it can begin where it must
    void* begin_ = nullptr;
    VmaPool pool_ = VK_NULL_HANDLE;
    VmaAllocation null_ = VK_NULL_HANDLE;  ///< the first bytes: no buffer gets them, so that no address is 0 modulo 2^32
    VkBuffer range_ = VK_NULL_HANDLE;      ///< all of it as one buffer
    VkBufferView view_ = VK_NULL_HANDLE;
    VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
    VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    std::atomic<bool> whole_ = true;
};

}  // namespace lodestir::gpu
