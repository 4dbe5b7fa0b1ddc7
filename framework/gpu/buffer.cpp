// SPDX-License-Identifier: MIT
// GPU memory reached by device address: the one kind of resource that passes see (images are linear arrays of texels in it).
#include <framework/gpu/buffer.h>

#include <framework/core/error.h>
#include <framework/gpu/array.h>
#include <framework/gpu/commands.h>
#include <framework/gpu/heap.h>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

namespace lodestir::gpu {

namespace {

constexpr std::size_t granule = 256;  // alignment of addresses, and what sizes are rounded up to

VkBufferUsageFlags usage(const Device& device) {
    VkBufferUsageFlags flags = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                               VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    if (device.facts().rayQuery)
        flags |=
            VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR | VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR;
    return flags;
}

VmaAllocationCreateInfo placement(const Device& device, Memory memory) {
    VmaAllocationCreateInfo info{};
    info.usage = VMA_MEMORY_USAGE_AUTO;
    if (memory == Memory::upload) {
        info.flags = VMA_ALLOCATION_CREATE_MAPPED_BIT | VMA_ALLOCATION_CREATE_HOST_ACCESS_SEQUENTIAL_WRITE_BIT;
        info.requiredFlags = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    } else if (memory == Memory::readback || device.facts().unifiedMemory) {
        info.flags = VMA_ALLOCATION_CREATE_MAPPED_BIT | VMA_ALLOCATION_CREATE_HOST_ACCESS_RANDOM_BIT;
        info.requiredFlags = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    } else {
        info.usage = VMA_MEMORY_USAGE_AUTO_PREFER_DEVICE;
    }
    return info;
}

}  // namespace

// Starts from the empty buffer, so that the destructor frees what is there when a later step throws.
Buffer::Buffer(const Device& device, std::size_t size, Memory memory, const std::string& name) : Buffer() {
    device_ = &device;
    size_ = (std::max<std::size_t>(size, 1) + granule - 1) / granule * granule;
    const auto mebibytes = static_cast<double>(size) / (1 << 20);
    if (size_ < size || size_ > device.facts().maxBufferBytes)
        throw Error(fmt::format("buffer \"{}\" needs {:.1f} MiB, the device allows {:.1f} MiB", name, mebibytes,
                                static_cast<double>(device.facts().maxBufferBytes) / (1 << 20)),
                    "a smaller image or scene would fit");

    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size_;
    info.usage = usage(device);
    VmaAllocationCreateInfo where = placement(device, memory);
    VmaAllocationInfo allocated{};
    VkExternalMemoryBufferCreateInfo external{};
    external.sType = VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_BUFFER_CREATE_INFO;
    external.handleTypes = VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT;
    Heap* heap = memory == Memory::readback ? nullptr : device.heap();
    if (heap) {
        info.pNext = &external;
        where.pool = heap->pool();
    }
    const auto create = [&] { return vmaCreateBufferWithAlignment(device.allocator(), &info, &where, granule, &buffer_, &allocation_, &allocated); };
    VkResult result = create();
    if (heap && result != VK_SUCCESS) {
        heap->overflow();
        info.pNext = nullptr;
        where.pool = VK_NULL_HANDLE;
        result = create();
    }
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY)
        throw Error(fmt::format("out of memory: buffer \"{}\" needs {:.1f} MiB", name, mebibytes), "a smaller image or scene would fit");
    check(result, "vmaCreateBuffer");
    mapped_ = static_cast<std::byte*>(allocated.pMappedData);

    const VkBufferDeviceAddressInfo addressInfo{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, nullptr, buffer_};
    address_ = vkGetBufferDeviceAddress(device.handle(), &addressInfo);
    assert(address_ % granule == 0);
    device.setName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(buffer_), name);
    vmaSetAllocationName(device.allocator(), allocation_, name.c_str());
}

Buffer::~Buffer() {
    if (buffer_) vmaDestroyBuffer(device_->allocator(), buffer_, allocation_);
}

Buffer::Buffer(Buffer&& other) noexcept { *this = std::move(other); }

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(buffer_, other.buffer_);
    std::swap(allocation_, other.allocation_);
    std::swap(address_, other.address_);
    std::swap(size_, other.size_);
    std::swap(mapped_, other.mapped_);
    return *this;
}

Buffer makeBuffer(const Device& device, std::span<const std::byte> bytes, const std::string& name) {
    Buffer buffer(device, bytes.size(), Memory::device, name);
    fillBuffer(device, buffer, bytes);
    return buffer;
}

void readBuffer(const Device& device, const Buffer& buffer, std::size_t offset, std::span<std::byte> out) {
    if (offset > buffer.size() || out.size() > buffer.size() - offset)
        throw Error(fmt::format("reading bytes {}..{} of a buffer of {} bytes", offset, offset + out.size(), buffer.size()));
    if (out.empty()) return;
    if (buffer.mapped()) {
        device.waitIdle();
        std::memcpy(out.data(), buffer.mapped() + offset, out.size());
        return;
    }
    const Buffer staging(device, out.size(), Memory::readback, "readback");
    runOnce(device, [&](Commands& commands) {
        commands.barrier();
        commands.copy(buffer, offset, staging, 0, out.size());
    });
    std::memcpy(out.data(), staging.mapped(), out.size());
}

}  // namespace lodestir::gpu
