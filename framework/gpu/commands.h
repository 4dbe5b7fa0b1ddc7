// SPDX-License-Identifier: MIT
// One command buffer: dispatches, barriers, copies, fills, labels and timestamps, submitted and waited for.
#pragma once
#include <framework/gpu/buffer.h>
#include <framework/gpu/pipeline.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace lodestir::gpu {

class LODESTIR_API Commands {
public:
    explicit Commands(const Device& device, std::uint32_t maxTimestamps = 512);
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    void begin();  ///< waits for an earlier submission of this object
    /// `push` is as long as the pipeline's push block; a count of 0 does nothing. Error when the device can't dispatch so many groups.
    void dispatch(const Pipeline& pipeline, std::span<const std::byte> push, std::uint32_t x, std::uint32_t y = 1, std::uint32_t z = 1);
    /// Everything written before (compute shaders, transfers) is visible to everything after (compute, transfers, host).
    void barrier();
    void copy(const Buffer& from, std::size_t fromOffset, const Buffer& to, std::size_t toOffset, std::size_t size);
    void fill(const Buffer& buffer, std::size_t offset, std::size_t size, std::uint32_t value);  ///< offset and size in multiples of 4
    void beginLabel(const std::string& name);
    void endLabel();
    std::uint32_t timestamp();        ///< index of the written stamp (all earlier work finished); Error beyond maxTimestamps
    void submit();                    ///< ends and submits; returns at once; results are visible to the host after wait()
    void submit(VkSemaphore after, VkSemaphore before);  ///< the same, starting when `after` is signalled and signalling `before` at the end
    void wait();                      ///< until the submission is done; Error when the device is lost
    /// Between two stamps of the last finished submission; 0 where the device has no timestamps.
    double milliseconds(std::uint32_t from, std::uint32_t to) const;
    VkCommandBuffer handle() const { return commands_; }

private:
    Commands(const Device* device, std::uint32_t maxTimestamps);  ///< holds nothing yet
    const Device* device_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    VkQueryPool queries_ = VK_NULL_HANDLE;
    std::uint32_t maxTimestamps_, nextTimestamp_ = 0;
    bool pending_ = false;  ///< submitted and not yet waited for
    std::vector<std::uint64_t> stamps_;
};

/// Records, submits and waits in one call.
LODESTIR_API void runOnce(const Device& device, const std::function<void(Commands&)>& record);

}  // namespace lodestir::gpu
