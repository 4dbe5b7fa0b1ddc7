// SPDX-License-Identifier: MIT
// What the framework asks of a device: one table, read for `lodestir devices`, for choosing, and for switching features on.
#include <framework/gpu/features.h>

#include <framework/gpu/jit_cpu.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace lodestir::gpu {

namespace {

// One feature bit: where it lies, what has to be switched on for it, and what is done without it ("" = it is required).
struct Row {
    const char* name;
    VkBool32* (*bit)(FeatureChain&);
    std::vector<const char*> extensions;
    const char* fallback;
};

const std::vector<Row>& rows() {
    static const std::vector<Row> table{
        {"bufferDeviceAddress", [](FeatureChain& c) { return &c.v12.bufferDeviceAddress; }, {}, ""},
        {"scalarBlockLayout", [](FeatureChain& c) { return &c.v12.scalarBlockLayout; }, {}, ""},
        {"shaderInt64", [](FeatureChain& c) { return &c.core.features.shaderInt64; }, {}, ""},
        {"shaderInt16", [](FeatureChain& c) { return &c.core.features.shaderInt16; }, {}, ""},
        {"shaderInt8", [](FeatureChain& c) { return &c.v12.shaderInt8; }, {}, ""},
        {"storageBuffer16BitAccess", [](FeatureChain& c) { return &c.v11.storageBuffer16BitAccess; }, {}, ""},
        {"storageBuffer8BitAccess", [](FeatureChain& c) { return &c.v12.storageBuffer8BitAccess; }, {}, ""},
        {"shaderBufferInt64Atomics", [](FeatureChain& c) { return &c.v12.shaderBufferInt64Atomics; }, {}, ""},
        {"descriptorIndexing", [](FeatureChain& c) { return &c.v12.descriptorIndexing; }, {}, ""},
        {"shaderSubgroupExtendedTypes", [](FeatureChain& c) { return &c.v12.shaderSubgroupExtendedTypes; }, {}, ""},
        {"subgroupBroadcastDynamicId", [](FeatureChain& c) { return &c.v12.subgroupBroadcastDynamicId; }, {}, ""},
        {"subgroupSizeControl", [](FeatureChain& c) { return &c.v13.subgroupSizeControl; }, {}, ""},
        {"hostQueryReset", [](FeatureChain& c) { return &c.v12.hostQueryReset; }, {}, ""},
        {"synchronization2", [](FeatureChain& c) { return &c.v13.synchronization2; }, {}, ""},
        {"maintenance4", [](FeatureChain& c) { return &c.v13.maintenance4; }, {}, ""},
        {"dynamicRendering", [](FeatureChain& c) { return &c.v13.dynamicRendering; }, {}, ""},
        {"accelerationStructure",
         [](FeatureChain& c) { return &c.acceleration.accelerationStructure; },
         {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME},
         "rays walk our own BVH"},
        {"rayQuery",
         [](FeatureChain& c) { return &c.rayQuery.rayQuery; },
         {VK_KHR_RAY_QUERY_EXTENSION_NAME, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME},
         "rays walk our own BVH"},
        {"shaderBufferFloat32AtomicAdd",
         [](FeatureChain& c) { return &c.atomicFloat.shaderBufferFloat32AtomicAdd; },
         {VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME},
         "compare-and-swap loops"},
        {"shaderFloat64", [](FeatureChain& c) { return &c.core.features.shaderFloat64; }, {}, "sums in pairs of floats"},
        {"runtimeDescriptorArray", [](FeatureChain& c) { return &c.v12.runtimeDescriptorArray; }, {}, "textures are read from buffers"},
        {"shaderSampledImageArrayNonUniformIndexing",
         [](FeatureChain& c) { return &c.v12.shaderSampledImageArrayNonUniformIndexing; },
         {},
         "textures are read from buffers"},
    };
    return table;
}

bool hasAll(const std::set<std::string>& extensions, const std::vector<const char*>& wanted) {
    return std::ranges::all_of(wanted, [&](const char* name) { return extensions.contains(name); });
}

const char* typeName(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU: return "cpu";
    default: return "other";
    }
}

std::string versionText(std::uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version), VK_API_VERSION_PATCH(version));
}

// True when every memory type that a device buffer may lie in can be written in place by the CPU, without a slow bus between.
bool hasUnifiedMemory(const VkPhysicalDeviceMemoryProperties& memory, VkPhysicalDeviceType type) {
    if (type != VK_PHYSICAL_DEVICE_TYPE_CPU && type != VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU) return false;
    constexpr VkMemoryPropertyFlags inPlace = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                              VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    return std::any_of(memory.memoryTypes, memory.memoryTypes + memory.memoryTypeCount,
                       [](const VkMemoryType& t) { return (t.propertyFlags & inPlace) == inPlace; });
}

}  // namespace

FeatureChain::FeatureChain() {
    v11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES;
    v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    atomicFloat.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_ATOMIC_FLOAT_FEATURES_EXT;
    acceleration.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR;
    rayQuery.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR;
}

VkPhysicalDeviceFeatures2* FeatureChain::link(const std::set<std::string>& extensions) {
    core.pNext = &v11;
    v11.pNext = &v12;
    v12.pNext = &v13;
    void** next = &v13.pNext;
    *next = nullptr;
    const auto append = [&](auto& structure, const char* extension) {
        if (!extensions.contains(extension)) return;
        *next = &structure;
        next = &structure.pNext;
        *next = nullptr;
    };
    append(atomicFloat, VK_EXT_SHADER_ATOMIC_FLOAT_EXTENSION_NAME);
    append(acceleration, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME);
    append(rayQuery, VK_KHR_RAY_QUERY_EXTENSION_NAME);
    return &core;
}

std::set<std::string> deviceExtensions(VkPhysicalDevice physical) {
    std::uint32_t count = 0;
    check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr), "vkEnumerateDeviceExtensionProperties");
    std::vector<VkExtensionProperties> properties(count);
    check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, properties.data()), "vkEnumerateDeviceExtensionProperties");
    std::set<std::string> names;
    for (const VkExtensionProperties& p : properties) names.insert(p.extensionName);
    return names;
}

int findQueueFamily(VkPhysicalDevice physical) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    int found = -1;
    for (int i = static_cast<int>(count) - 1; i >= 0; --i) {
        const VkQueueFlags flags = families[i].queueFlags;
        if (!(flags & VK_QUEUE_COMPUTE_BIT)) continue;
        if (found < 0 || (flags & VK_QUEUE_GRAPHICS_BIT) || !(families[found].queueFlags & VK_QUEUE_GRAPHICS_BIT)) found = i;
    }
    return found;
}

DeviceFacts describeDevice(VkPhysicalDevice physical, int index) {
    DeviceFacts facts;
    facts.index = index;

    VkPhysicalDeviceSubgroupSizeControlProperties sizeControl{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_PROPERTIES, nullptr, 0, 0, 0, 0};
    VkPhysicalDeviceMaintenance4Properties maintenance4{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES, nullptr, 0};
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    VkPhysicalDeviceSubgroupProperties subgroup{};
    subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    vkGetPhysicalDeviceProperties2(physical, &properties);
    const VkPhysicalDeviceProperties& base = properties.properties;
    const bool is13 = base.apiVersion >= VK_API_VERSION_1_3;
    if (is13) {  // older devices don't know the structures
        properties.pNext = &driver;
        driver.pNext = &subgroup;
        subgroup.pNext = &sizeControl;
        sizeControl.pNext = &maintenance4;
        vkGetPhysicalDeviceProperties2(physical, &properties);
    }
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);

    facts.name = base.deviceName;
    facts.driver = driver.driverName;
    facts.driverVersion = driver.driverInfo[0] ? std::string(driver.driverInfo) : versionText(base.driverVersion);
    facts.apiVersion = versionText(base.apiVersion);
    facts.type = typeName(base.deviceType);
    facts.isLavapipe = driver.driverID == VK_DRIVER_ID_MESA_LLVMPIPE;
    facts.subgroupSize = subgroup.subgroupSize;
    facts.pinsSubgroupSize = sizeControl.requiredSubgroupSizeStages & VK_SHADER_STAGE_COMPUTE_BIT;
    facts.unifiedMemory = hasUnifiedMemory(memory, base.deviceType);
    facts.timestampPeriod = base.limits.timestampPeriod;
    std::copy_n(base.limits.maxComputeWorkGroupCount, 3, facts.maxGroups);
    facts.maxPushBytes = base.limits.maxPushConstantsSize;
    facts.maxBufferBytes = maintenance4.maxBufferSize;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) facts.memoryBytes += memory.memoryHeaps[i].size;

    const int family = findQueueFamily(physical);
    if (family >= 0) {
        std::vector<VkQueueFamilyProperties> families(static_cast<std::size_t>(family) + 1);
        auto count = static_cast<std::uint32_t>(families.size());
        vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
        facts.timestampBits = families[static_cast<std::size_t>(family)].timestampValidBits;
    }

    const auto add = [&](std::string name, bool present, std::string fallback) {
        facts.features.push_back({std::move(name), fallback.empty(), present, std::move(fallback)});
    };
    const auto extensions = deviceExtensions(physical);
    FeatureChain chain;
    if (is13) vkGetPhysicalDeviceFeatures2(physical, chain.link(extensions));
    constexpr VkSubgroupFeatureFlags operations = VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_VOTE_BIT |
                                                  VK_SUBGROUP_FEATURE_BALLOT_BIT | VK_SUBGROUP_FEATURE_SHUFFLE_BIT |
                                                  VK_SUBGROUP_FEATURE_SHUFFLE_RELATIVE_BIT | VK_SUBGROUP_FEATURE_ARITHMETIC_BIT;
    add("Vulkan 1.3", is13, "");
    add("compute queue", family >= 0, "");
    add("subgroup vote, ballot, shuffle, arithmetic",
        (subgroup.supportedOperations & operations) == operations && (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT), "");
    for (const Row& row : rows()) add(row.name, is13 && *row.bit(chain) && hasAll(extensions, row.extensions), row.fallback);
    add("requiredSubgroupSize", facts.pinsSubgroupSize, "the driver chooses the subgroup size");
    add("timestamps", facts.timestampBits > 0, "GPU times read 0");
    add(VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME, extensions.contains(VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME),
        "records are read by address, which only CPU drivers are slower with");
    add("VK_KHR_swapchain", extensions.contains(VK_KHR_SWAPCHAIN_EXTENSION_NAME), "no window; everything else works");
    const auto found = std::ranges::find(facts.features, "rayQuery", &Feature::name);
    const auto structure = std::ranges::find(facts.features, "accelerationStructure", &Feature::name);
    facts.rayQuery = found->present && structure->present;
    const char* records = std::getenv("LODESTIR_RECORDS");
    const bool wanted = records ? std::string_view(records) == "texels" : gathersOfCpu() == Gathers::none;
    facts.readsTexels = facts.isLavapipe && wanted && extensions.contains(VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME);
    return facts;
}

std::vector<const char*> enableFeatures(VkPhysicalDevice physical, bool window, FeatureChain& chain) {
    const auto extensions = deviceExtensions(physical);
    FeatureChain present;
    vkGetPhysicalDeviceFeatures2(physical, present.link(extensions));
    std::set<std::string> enabled;
    std::vector<const char*> names;
    const auto enable = [&](const char* name) {
        if (enabled.insert(name).second) names.push_back(name);
    };
    for (const Row& row : rows()) {
        if (!*row.bit(present) || !hasAll(extensions, row.extensions)) continue;
        *row.bit(chain) = VK_TRUE;
        std::ranges::for_each(row.extensions, enable);
    }
    if (extensions.contains(VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME)) enable(VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME);
    if (window) enable(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    chain.link(enabled);
    return names;
}

}  // namespace lodestir::gpu
