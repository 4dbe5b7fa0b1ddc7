// SPDX-License-Identifier: MIT
// One command buffer: dispatches, barriers, copies, fills, labels and timestamps, submitted and waited for.
#include <framework/gpu/commands.h>

#include <framework/core/error.h>
#include <framework/gpu/heap.h>

#include <fmt/format.h>

#include <cassert>

namespace lodestir::gpu {

Commands::Commands(const Device* device, std::uint32_t maxTimestamps) : device_(device), maxTimestamps_(maxTimestamps) {}

// Starts from the empty object, so that the destructor frees what is there when a later step throws.
Commands::Commands(const Device& device, std::uint32_t maxTimestamps)
    : Commands(&device, device.facts().timestampBits ? maxTimestamps : 0) {
    VkCommandPoolCreateInfo poolInfo{};
    poolInfo.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    poolInfo.queueFamilyIndex = device.queueFamily();
    check(vkCreateCommandPool(device.handle(), &poolInfo, nullptr, &pool_), "vkCreateCommandPool");

    VkCommandBufferAllocateInfo bufferInfo{};
    bufferInfo.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    bufferInfo.commandPool = pool_;
    bufferInfo.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    bufferInfo.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device.handle(), &bufferInfo, &commands_), "vkAllocateCommandBuffers");

    VkFenceCreateInfo fenceInfo{};
    fenceInfo.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    check(vkCreateFence(device.handle(), &fenceInfo, nullptr, &fence_), "vkCreateFence");

    if (maxTimestamps_ == 0) return;
    VkQueryPoolCreateInfo queryInfo{};
    queryInfo.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    queryInfo.queryType = VK_QUERY_TYPE_TIMESTAMP;
    queryInfo.queryCount = maxTimestamps_;
    check(vkCreateQueryPool(device.handle(), &queryInfo, nullptr, &queries_), "vkCreateQueryPool");
}

Commands::~Commands() {
    if (pending_) vkWaitForFences(device_->handle(), 1, &fence_, VK_TRUE, UINT64_MAX);
    vkDestroyQueryPool(device_->handle(), queries_, nullptr);
    vkDestroyFence(device_->handle(), fence_, nullptr);
    vkDestroyCommandPool(device_->handle(), pool_, nullptr);
}

void Commands::begin() {
    if (pending_) wait();
    check(vkResetCommandPool(device_->handle(), pool_, 0), "vkResetCommandPool");
    if (queries_) vkResetQueryPool(device_->handle(), queries_, 0, maxTimestamps_);
    nextTimestamp_ = 0;
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands_, &info), "vkBeginCommandBuffer");
}

void Commands::dispatch(const Pipeline& pipeline, std::span<const std::byte> push, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    assert(pipeline && push.size() <= pipeline.pushBytes());
    const auto& most = device_->facts().maxGroups;
    if (x > most[0] || y > most[1] || z > most[2])
        throw Error(
            fmt::format("a dispatch of {} x {} x {} workgroups; the device allows {} x {} x {}", x, y, z, most[0], most[1], most[2]));
    if (x == 0 || y == 0 || z == 0) return;
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle());
    if (const Heap* heap = device_->heap()) {
        const VkDescriptorSet set = heap->set();
        vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout(), 0, 1, &set, 0, nullptr);
    }
    if (!push.empty())
        vkCmdPushConstants(commands_, pipeline.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0, static_cast<std::uint32_t>(push.size()),
                           push.data());
    vkCmdDispatch(commands_, x, y, z);
}

void Commands::barrier() {
    VkMemoryBarrier2 memory{};
    memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    memory.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    memory.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    memory.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_HOST_BIT;
    memory.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &memory;
    vkCmdPipelineBarrier2(commands_, &info);
}

void Commands::copy(const Buffer& from, std::size_t fromOffset, const Buffer& to, std::size_t toOffset, std::size_t size) {
    assert(fromOffset + size <= from.size() && toOffset + size <= to.size());
    if (size == 0) return;
    const VkBufferCopy region{fromOffset, toOffset, size};
    vkCmdCopyBuffer(commands_, from.handle(), to.handle(), 1, &region);
}

void Commands::fill(const Buffer& buffer, std::size_t offset, std::size_t size, std::uint32_t value) {
    assert(offset % 4 == 0 && size % 4 == 0 && offset + size <= buffer.size());
    if (size > 0) vkCmdFillBuffer(commands_, buffer.handle(), offset, size, value);
}

void Commands::beginLabel(const std::string& name) { device_->beginLabel(commands_, name); }

void Commands::endLabel() { device_->endLabel(commands_); }

std::uint32_t Commands::timestamp() {
    if (!queries_) return 0;
    if (nextTimestamp_ == maxTimestamps_) throw Error(fmt::format("more than {} timestamps in one command buffer", maxTimestamps_));
    vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, nextTimestamp_);
    return nextTimestamp_++;
}

void Commands::submit() { submit(VK_NULL_HANDLE, VK_NULL_HANDLE); }

void Commands::submit(VkSemaphore after, VkSemaphore before) {
    barrier();  // makes the results visible to the host
    check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
    check(vkResetFences(device_->handle(), 1, &fence_), "vkResetFences");
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_;
    const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    info.waitSemaphoreCount = after ? 1 : 0;
    info.pWaitSemaphores = &after;
    info.pWaitDstStageMask = &stage;
    info.signalSemaphoreCount = before ? 1 : 0;
    info.pSignalSemaphores = &before;
    const auto lock = device_->lockQueue();
    check(vkQueueSubmit(device_->queue(), 1, &info, fence_), "vkQueueSubmit");
    pending_ = true;
}

void Commands::wait() {
    if (!pending_) return;
    check(vkWaitForFences(device_->handle(), 1, &fence_, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    pending_ = false;
    stamps_.resize(nextTimestamp_);
    if (nextTimestamp_ == 0) return;
    check(vkGetQueryPoolResults(device_->handle(), queries_, 0, nextTimestamp_, stamps_.size() * sizeof stamps_[0], stamps_.data(),
                                sizeof stamps_[0], VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults");
}

double Commands::milliseconds(std::uint32_t from, std::uint32_t to) const {
    if (!queries_) return 0;
    const std::uint32_t bits = device_->facts().timestampBits;
    const std::uint64_t mask = bits >= 64 ? ~0ull : (1ull << bits) - 1;
    return static_cast<double>((stamps_.at(to) - stamps_.at(from)) & mask) * device_->facts().timestampPeriod * 1e-6;
}

void runOnce(const Device& device, const std::function<void(Commands&)>& record) {
    Commands commands(device, 0);
    commands.begin();
    record(commands);
    commands.submit();
    commands.wait();
}

}  // namespace lodestir::gpu
