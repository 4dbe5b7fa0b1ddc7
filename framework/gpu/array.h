// SPDX-License-Identifier: MIT
// Arrays that the CPU fills and the GPU reads: where they share memory there is one of each.
#pragma once
#include <framework/gpu/buffer.h>

#include <span>
#include <string>
#include <vector>

namespace lodestir::gpu {

/// Puts `bytes` at the start of a buffer (through a staging copy where needed); waits for the copy.
LODESTIR_API void fillBuffer(const Device& device, const Buffer& buffer, std::span<const std::byte> bytes);

template <class T> class Array {
public:
    Array() = default;
    /// `count` values, to be filled. Without a device they stay with the CPU. Error when memory is out.
    Array(const Device* device, std::size_t count, const std::string& name) : device_(device), count_(count) {
        if (device) buffer_ = Buffer(*device, count * sizeof(T), Memory::device, name);
        if (!buffer_.mapped()) own_.resize(count);
    }

    std::span<T> values() { return {buffer_.mapped() ? reinterpret_cast<T*>(buffer_.mapped()) : own_.data(), count_}; }
    std::span<const T> values() const { return {buffer_.mapped() ? reinterpret_cast<const T*>(buffer_.mapped()) : own_.data(), count_}; }
    /// Lets the GPU see what was written.
    void upload() {
        if (buffer_ && !buffer_.mapped()) fillBuffer(*device_, buffer_, std::as_bytes(std::span(own_)));
    }
    const Buffer& buffer() const { return buffer_; }  ///< empty without a device

private:
    const Device* device_ = nullptr;
    std::size_t count_ = 0;
    Buffer buffer_;
    std::vector<T> own_;  ///< where the CPU does not see the buffer
};

}  // namespace lodestir::gpu
