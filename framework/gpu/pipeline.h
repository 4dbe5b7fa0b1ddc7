// SPDX-License-Identifier: MIT
// A compute pipeline: SPIR-V plus specialization constants plus one push-constant block; no descriptors but the optional texture table.
#pragma once
#include <framework/gpu/device.h>
#include <framework/gpu/shader.h>

#include <cstdint>
#include <span>
#include <string>

namespace lodestir::gpu {

struct Specialization { std::uint32_t id; std::uint32_t value; };  ///< value: bits of an int, uint, float or bool (0/1)

class LODESTIR_API Pipeline {
public:
    Pipeline() = default;
    /// `pushBytes` (rounded up to 4) is the size of the push block. The subgroup size is the device's own, facts().subgroupSize.
    Pipeline(const Device& device, const Spirv& spirv, std::span<const Specialization> constants, std::uint32_t pushBytes,
             const std::string& name);
    ~Pipeline();
    Pipeline(Pipeline&& other) noexcept;
    Pipeline& operator=(Pipeline&& other) noexcept;
    explicit operator bool() const { return pipeline_ != VK_NULL_HANDLE; }
    VkPipeline handle() const { return pipeline_; }
    VkPipelineLayout layout() const { return layout_; }
    std::uint32_t pushBytes() const { return pushBytes_; }

private:
    const Device* device_ = nullptr;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    std::uint32_t pushBytes_ = 0;
};

}  // namespace lodestir::gpu
