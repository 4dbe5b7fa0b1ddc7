// SPDX-License-Identifier: MIT
// GPU memory reached by device address: the one kind of resource that passes see (images are linear arrays of texels in it).
#pragma once
#include <framework/gpu/device.h>

#include <cstddef>
#include <span>
#include <string>

namespace lodestir::gpu {

enum class Memory {
    device,    ///< fast for the GPU; filled by upload or by shaders
    upload,    ///< host-visible, written by the CPU, read by the GPU
    readback,  ///< host-visible and cached, written by the GPU, read by the CPU
};

class LODESTIR_API Buffer {
public:
    Buffer() = default;
    /// Size in bytes (rounded up to 256, at least 256). `name` shows in debuggers and validation messages. Error when memory is out.
    Buffer(const Device& device, std::size_t size, Memory memory, const std::string& name);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    explicit operator bool() const { return buffer_ != VK_NULL_HANDLE; }
    VkBuffer handle() const { return buffer_; }
    VkDeviceAddress address() const { return address_; }  ///< aligned to 256 bytes
    std::size_t size() const { return size_; }
    std::byte* mapped() const { return mapped_; }         ///< nullptr for Memory::device, unless the device's memory is the CPU's own

private:
    const Device* device_ = nullptr;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VmaAllocation allocation_ = VK_NULL_HANDLE;
    VkDeviceAddress address_ = 0;
    std::size_t size_ = 0;
    std::byte* mapped_ = nullptr;
};

/// Creates a device buffer holding `bytes` (through a staging copy where needed); waits for the copy.
LODESTIR_API Buffer makeBuffer(const Device& device, std::span<const std::byte> bytes, const std::string& name);
template <class T> Buffer makeBuffer(const Device& device, std::span<const T> values, const std::string& name) {
    return makeBuffer(device, std::as_bytes(values), name);
}
/// Reads back [offset, offset + out.size()) of any buffer; waits. The buffer must not be in use by unsubmitted work.
LODESTIR_API void readBuffer(const Device& device, const Buffer& buffer, std::size_t offset, std::span<std::byte> out);

}  // namespace lodestir::gpu
