// SPDX-License-Identifier: MIT
// The memory that shaders write into what they tell of a pixel, read after each dispatch.
#pragma once
#include <framework/gpu/buffer.h>
#include <framework/graph/probe.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

namespace lodestir {

class ProbeMemory {
public:
    explicit ProbeMemory(const gpu::Device& device)
        : buffer_(device, sizeof(ProbeHead) + capacity * sizeof(ProbeRecord), gpu::Memory::readback, "probe") {
        ask(nowhere);
    }

    VkDeviceAddress address() const { return buffer_.address(); }
    bool asks() const { return pixel_ != nowhere; }
    /// From now on shaders are asked about a pixel.
    void ask(glm::ivec2 pixel) {
        pixel_ = pixel;
        const ProbeHead head{pixel, capacity, 0};
        std::memcpy(buffer_.mapped(), &head, sizeof head);
    }
    /// A dispatch is over, and the device idle.
    void told(int node, std::string_view shader, std::span<const std::uint32_t> arguments, std::shared_ptr<const ProbeSites> sites) {
        ProbeHead head;
        std::memcpy(&head, buffer_.mapped(), sizeof head);
        const std::uint32_t kept = std::min(head.count, capacity);
        ProbedDispatch dispatch{node, std::string(shader), {arguments.begin(), arguments.end()}, std::move(sites), {}, head.count - kept};
        dispatch.records.resize(kept);
        std::memcpy(dispatch.records.data(), buffer_.mapped() + sizeof head, kept * sizeof(ProbeRecord));
        told_.push_back(std::move(dispatch));
        ask(pixel_);
    }
    /// All that was told. Nobody is asked any more.
    std::vector<ProbedDispatch> take() {
        ask(nowhere);
        return std::exchange(told_, {});
    }

private:
    static constexpr std::uint32_t capacity = 1u << 16;
    static constexpr glm::ivec2 nowhere{-1, -1};
    gpu::Buffer buffer_;
    glm::ivec2 pixel_ = nowhere;
    std::vector<ProbedDispatch> told_;
};

}  // namespace lodestir
