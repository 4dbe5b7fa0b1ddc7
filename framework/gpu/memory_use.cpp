// SPDX-License-Identifier: MIT
#include <framework/gpu/memory_use.h>

#include <algorithm>
#include <array>

namespace lodestir::gpu {

double memoryShare(const Device& device) {
    const VkPhysicalDeviceMemoryProperties* memory = nullptr;
    vmaGetMemoryProperties(device.allocator(), &memory);
    std::array<VmaBudget, VK_MAX_MEMORY_HEAPS> budgets{};
    vmaGetHeapBudgets(device.allocator(), budgets.data());
    double share = 0;
    for (std::uint32_t heap = 0; heap < memory->memoryHeapCount; ++heap)
        share = std::max(share, double(budgets[heap].statistics.blockBytes) / double(memory->memoryHeaps[heap].size));
    return share;
}

}  // namespace lodestir::gpu
