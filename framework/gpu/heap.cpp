// SPDX-License-Identifier: MIT
// The one range of memory that a CPU driver's buffers lie in, which its shaders see as a texel buffer, too.
#include <framework/gpu/heap.h>

#include <framework/core/error.h>
#include <framework/gpu/device.h>

#include <sys/mman.h>

#include <bit>

namespace lodestir::gpu {

namespace {

constexpr VkDeviceSize size = 1ull << 31;            // what a view of 2^27 texels of 16 bytes covers: lavapipe's limit
constexpr std::uintptr_t alignment = 1ull << 32;     // the range's address, so that its lower half is that in the range
constexpr std::size_t reservation = alignment + size;

}  // namespace

Heap::Heap(const Device& device) : device_(device) {
    try {
        reserve();
        makePool();
        makeView();
        makeSet();
    } catch (...) {
        destroy();
        throw;
    }
}

Heap::~Heap() { destroy(); }

void Heap::reserve() {
    void* place = mmap(nullptr, reservation, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (place == MAP_FAILED) throw Error("no address space for the memory of shaders");
    reserved_ = place;
    begin_ = reinterpret_cast<void*>((reinterpret_cast<std::uintptr_t>(place) + alignment - 1) / alignment * alignment);
    if (mprotect(begin_, size, PROT_READ | PROT_WRITE) != 0) throw Error("no memory for shaders");
    madvise(begin_, size, MADV_HUGEPAGE);  // rays jump about in it; it is only a wish
}

void Heap::makePool() {
    constexpr auto kind = VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT;
    const auto typesOf = reinterpret_cast<PFN_vkGetMemoryHostPointerPropertiesEXT>(
        vkGetDeviceProcAddr(device_.handle(), "vkGetMemoryHostPointerPropertiesEXT"));
    VkMemoryHostPointerPropertiesEXT types{};
    types.sType = VK_STRUCTURE_TYPE_MEMORY_HOST_POINTER_PROPERTIES_EXT;
    check(typesOf(device_.handle(), kind, begin_, &types), "vkGetMemoryHostPointerPropertiesEXT");

    VkImportMemoryHostPointerInfoEXT import{};
    import.sType = VK_STRUCTURE_TYPE_IMPORT_MEMORY_HOST_POINTER_INFO_EXT;
    import.handleType = kind;
    import.pHostPointer = begin_;
    VmaPoolCreateInfo info{};
    info.memoryTypeIndex = static_cast<std::uint32_t>(std::countr_zero(types.memoryTypeBits));
    info.blockSize = size;
    info.minBlockCount = info.maxBlockCount = 1;
    info.pMemoryAllocateNext = &import;  // read now alone: there is no second block
    check(vmaCreatePool(device_.allocator(), &info, &pool_), "vmaCreatePool");
}

void Heap::makeView() {
    VmaAllocationCreateInfo where{};
    where.pool = pool_;
    const VkMemoryRequirements least{256, 256, ~0u};
    VmaAllocationInfo allocated{};
    check(vmaAllocateMemory(device_.allocator(), &least, &where, &null_, &allocated), "vmaAllocateMemory");

    VkExternalMemoryBufferCreateInfo external{};
    external.sType = VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_BUFFER_CREATE_INFO;
    external.handleTypes = VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT;
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.pNext = &external;
    info.size = size;
    info.usage = VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
    check(vkCreateBuffer(device_.handle(), &info, nullptr, &range_), "vkCreateBuffer");
    check(vkBindBufferMemory(device_.handle(), range_, allocated.deviceMemory, 0), "vkBindBufferMemory");

    VkBufferViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
    view.buffer = range_;
    view.format = VK_FORMAT_R32G32B32A32_UINT;
    view.range = VK_WHOLE_SIZE;
    check(vkCreateBufferView(device_.handle(), &view, nullptr, &view_), "vkCreateBufferView");
}

void Heap::makeSet() {
    const VkDescriptorSetLayoutBinding binding{0, VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
    VkDescriptorSetLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    layout.bindingCount = 1;
    layout.pBindings = &binding;
    check(vkCreateDescriptorSetLayout(device_.handle(), &layout, nullptr, &layout_), "vkCreateDescriptorSetLayout");
    const VkDescriptorPoolSize one{VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, 1};
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &one;
    check(vkCreateDescriptorPool(device_.handle(), &pool, nullptr, &descriptors_), "vkCreateDescriptorPool");
    VkDescriptorSetAllocateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    set.descriptorPool = descriptors_;
    set.descriptorSetCount = 1;
    set.pSetLayouts = &layout_;
    check(vkAllocateDescriptorSets(device_.handle(), &set, &set_), "vkAllocateDescriptorSets");
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set_;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
    write.pTexelBufferView = &view_;
    vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
}

void Heap::destroy() {
    vkDestroyDescriptorPool(device_.handle(), descriptors_, nullptr);
    vkDestroyDescriptorSetLayout(device_.handle(), layout_, nullptr);
    vkDestroyBufferView(device_.handle(), view_, nullptr);
    vkDestroyBuffer(device_.handle(), range_, nullptr);
    vmaFreeMemory(device_.allocator(), null_);
    if (pool_) vmaDestroyPool(device_.allocator(), pool_);
    if (reserved_) munmap(reserved_, reservation);
}

}  // namespace lodestir::gpu
