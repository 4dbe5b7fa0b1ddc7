// SPDX-License-Identifier: MIT
// A compute pipeline: SPIR-V plus specialization constants plus one push-constant block.
#include <framework/gpu/pipeline.h>

#include <framework/core/error.h>
#include <framework/gpu/heap.h>

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace lodestir::gpu {

// Starts from the empty pipeline, so that the destructor frees what is there when a later step throws.
Pipeline::Pipeline(const Device& device, const Spirv& spirv, std::span<const Specialization> constants, std::uint32_t pushBytes,
                   const std::string& name)
    : Pipeline() {
    device_ = &device;
    pushBytes_ = (pushBytes + 3) / 4 * 4;
    if (pushBytes_ > device.facts().maxPushBytes)
        throw Error(fmt::format("{}: {} bytes of push constants, the device allows {}", name, pushBytes_, device.facts().maxPushBytes));

    const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, pushBytes_};
    VkPipelineLayoutCreateInfo layoutInfo{};
    layoutInfo.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    const VkDescriptorSetLayout texels = device.heap() ? device.heap()->layout() : VK_NULL_HANDLE;
    layoutInfo.setLayoutCount = texels ? 1 : 0;
    layoutInfo.pSetLayouts = &texels;
    layoutInfo.pushConstantRangeCount = pushBytes_ ? 1 : 0;
    layoutInfo.pPushConstantRanges = &range;
    check(vkCreatePipelineLayout(device.handle(), &layoutInfo, nullptr, &layout_), "vkCreatePipelineLayout");

    std::vector<VkSpecializationMapEntry> entries;
    for (const Specialization& constant : constants) {
        const auto offset = static_cast<std::uint32_t>(entries.size() * sizeof(Specialization) + offsetof(Specialization, value));
        entries.push_back({constant.id, offset, sizeof constant.value});
    }
    const VkSpecializationInfo specialization{static_cast<std::uint32_t>(entries.size()), entries.data(), constants.size_bytes(),
                                              constants.data()};

    VkShaderModuleCreateInfo moduleInfo{};
    moduleInfo.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    moduleInfo.codeSize = spirv.words.size() * sizeof(std::uint32_t);
    moduleInfo.pCode = spirv.words.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device.handle(), &moduleInfo, nullptr, &module), "vkCreateShaderModule");

    // SPIR-V 1.6 lets the driver vary the subgroup size from pipeline to pipeline; packets and tests count on one size.
    VkPipelineShaderStageRequiredSubgroupSizeCreateInfo subgroup{};
    subgroup.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO;
    subgroup.requiredSubgroupSize = device.facts().subgroupSize;
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.layout = layout_;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.pNext = device.facts().pinsSubgroupSize ? &subgroup : nullptr;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = entries.empty() ? nullptr : &specialization;
    const VkResult result = vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_);
    vkDestroyShaderModule(device.handle(), module, nullptr);
    check(result, "vkCreateComputePipelines");
    device.setName(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline_), name);
}

Pipeline::~Pipeline() {
    if (!device_) return;
    vkDestroyPipeline(device_->handle(), pipeline_, nullptr);
    vkDestroyPipelineLayout(device_->handle(), layout_, nullptr);
}

Pipeline::Pipeline(Pipeline&& other) noexcept { *this = std::move(other); }

Pipeline& Pipeline::operator=(Pipeline&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(pipeline_, other.pipeline_);
    std::swap(layout_, other.layout_);
    std::swap(pushBytes_, other.pushBytes_);
    return *this;
}

}  // namespace lodestir::gpu
