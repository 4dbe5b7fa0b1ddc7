// SPDX-License-Identifier: MIT
// The Vulkan instance, physical device, logical device and queue that everything runs on.
#include <framework/gpu/device.h>

#include <framework/core/error.h>
#include <framework/core/log.h>
#include <framework/gpu/features.h>
#include <framework/gpu/heap.h>
#include <framework/gpu/memory.h>
#include <framework/gpu/pipeline_cache.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cctype>
#include <cstdlib>
#include <functional>
#include <mutex>

namespace lodestir::gpu {

struct Device::Messages {
    std::mutex mutex;
    std::vector<std::string> texts;
    std::function<void(const char*)> receive;
};

namespace {

constexpr const char* validationLayer = "VK_LAYER_KHRONOS_validation";

const char* resultName(VkResult result) {
    switch (result) {
    case VK_NOT_READY: return "VK_NOT_READY";
    case VK_TIMEOUT: return "VK_TIMEOUT";
    case VK_INCOMPLETE: return "VK_INCOMPLETE";
    case VK_SUBOPTIMAL_KHR: return "VK_SUBOPTIMAL_KHR";
    case VK_ERROR_OUT_OF_HOST_MEMORY: return "VK_ERROR_OUT_OF_HOST_MEMORY";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY: return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
    case VK_ERROR_INITIALIZATION_FAILED: return "VK_ERROR_INITIALIZATION_FAILED";
    case VK_ERROR_DEVICE_LOST: return "VK_ERROR_DEVICE_LOST";
    case VK_ERROR_MEMORY_MAP_FAILED: return "VK_ERROR_MEMORY_MAP_FAILED";
    case VK_ERROR_LAYER_NOT_PRESENT: return "VK_ERROR_LAYER_NOT_PRESENT";
    case VK_ERROR_EXTENSION_NOT_PRESENT: return "VK_ERROR_EXTENSION_NOT_PRESENT";
    case VK_ERROR_FEATURE_NOT_PRESENT: return "VK_ERROR_FEATURE_NOT_PRESENT";
    case VK_ERROR_INCOMPATIBLE_DRIVER: return "VK_ERROR_INCOMPATIBLE_DRIVER";
    case VK_ERROR_TOO_MANY_OBJECTS: return "VK_ERROR_TOO_MANY_OBJECTS";
    case VK_ERROR_OUT_OF_POOL_MEMORY: return "VK_ERROR_OUT_OF_POOL_MEMORY";
    case VK_ERROR_FRAGMENTATION: return "VK_ERROR_FRAGMENTATION";
    case VK_ERROR_SURFACE_LOST_KHR: return "VK_ERROR_SURFACE_LOST_KHR";
    case VK_ERROR_OUT_OF_DATE_KHR: return "VK_ERROR_OUT_OF_DATE_KHR";
    case VK_ERROR_INVALID_SHADER_NV: return "VK_ERROR_INVALID_SHADER_NV";
    default: return nullptr;
    }
}

bool hasLayer(const char* name) {
    std::uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties");
    std::vector<VkLayerProperties> layers(count);
    check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "vkEnumerateInstanceLayerProperties");
    return std::ranges::any_of(layers, [&](const VkLayerProperties& l) { return std::string_view(l.layerName) == name; });
}

bool hasInstanceExtension(const char* name) {
    std::uint32_t count = 0;
    check(vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr), "vkEnumerateInstanceExtensionProperties");
    std::vector<VkExtensionProperties> extensions(count);
    check(vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data()), "vkEnumerateInstanceExtensionProperties");
    return std::ranges::any_of(extensions, [&](const VkExtensionProperties& e) { return std::string_view(e.extensionName) == name; });
}

// The result is VK_NULL_HANDLE where the machine has no Vulkan driver at all.
VkInstance createInstance(std::vector<const char*> extensions, const std::vector<const char*>& layers, const void* next) {
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "Lodestir";
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pNext = next;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
    info.ppEnabledLayerNames = layers.data();
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = vkCreateInstance(&info, nullptr, &instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) return VK_NULL_HANDLE;
    check(result, "vkCreateInstance");
    return instance;
}

std::vector<VkPhysicalDevice> physicalDevices(VkInstance instance) {
    std::uint32_t count = 0;
    VkResult result = vkEnumeratePhysicalDevices(instance, &count, nullptr);
    if (result == VK_ERROR_INITIALIZATION_FAILED) return {};  // the loader's answer when every driver refuses
    check(result, "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "vkEnumeratePhysicalDevices");
    return devices;
}

std::vector<DeviceFacts> describeAll(VkInstance instance) {
    std::vector<DeviceFacts> all;
    for (VkPhysicalDevice physical : physicalDevices(instance)) all.push_back(describeDevice(physical, static_cast<int>(all.size())));
    return all;
}

std::string lowered(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), [](unsigned char c) { return std::tolower(c); });
    return result;
}

// "0: llvmpipe" or "0: llvmpipe (lacks shaderInt64, synchronization2)".
std::string summary(const DeviceFacts& facts) {
    std::vector<std::string> missing;
    for (const Feature& feature : facts.features)
        if (feature.required && !feature.present) missing.push_back(feature.name);
    return fmt::format("{}: {}{}", facts.index, facts.name, missing.empty() ? "" : fmt::format(" (lacks {})", fmt::join(missing, ", ")));
}

int preference(const DeviceFacts& facts) {
    static const std::vector<std::string> order{"discrete", "integrated", "virtual", "cpu"};
    return static_cast<int>(std::ranges::find(order, facts.type) - order.begin());
}

VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    (*static_cast<const std::function<void(const char*)>*>(user))(data->pMessage);
    return VK_FALSE;
}

}  // namespace

bool DeviceFacts::usable() const {
    return std::ranges::all_of(features, [](const Feature& f) { return f.present || !f.required; });
}

void check(VkResult result, const char* call) {
    if (result == VK_SUCCESS) return;
    const char* name = resultName(result);
    throw Error(
        fmt::format("{} failed: {}", call, name ? name : fmt::format("VkResult {}", static_cast<int>(result))),
        result == VK_ERROR_DEVICE_LOST ? "the GPU stopped answering: a shader ran too long or touched memory that isn't its own" : "");
}

std::vector<DeviceFacts> listDevices() {
    VkInstance instance = createInstance({}, {}, nullptr);
    if (!instance) return {};
    const std::unique_ptr<VkInstance_T, void (*)(VkInstance)> owner(instance, [](VkInstance i) { vkDestroyInstance(i, nullptr); });
    return describeAll(instance);
}

std::size_t chooseDevice(const std::vector<DeviceFacts>& devices, const std::string& choice) {
    if (devices.empty())
        throw Error("no Vulkan device found", "install a Vulkan 1.3 driver; without a GPU, Mesa's lavapipe (24.1 or newer) does");
    std::vector<std::string> all;
    for (const DeviceFacts& facts : devices) all.push_back(summary(facts));

    std::vector<std::size_t> candidates;
    int wanted = -1;
    const auto [end, parsed] = std::from_chars(choice.data(), choice.data() + choice.size(), wanted);
    const bool isIndex = parsed == std::errc{} && end == choice.data() + choice.size();
    for (std::size_t i = 0; i < devices.size(); ++i)
        if (isIndex ? devices[i].index == wanted : lowered(devices[i].name).find(lowered(choice)) != std::string::npos)
            candidates.push_back(i);
    if (candidates.empty()) throw Error(fmt::format("no device \"{}\"", choice), fmt::format("devices: {}", fmt::join(all, ", ")));

    std::erase_if(candidates, [&](std::size_t i) { return !devices[i].usable(); });
    if (candidates.empty())
        throw Error(
            choice.empty() ? std::string("no device has all that is needed") : fmt::format("device \"{}\" lacks something needed", choice),
            fmt::format("devices: {}", fmt::join(all, ", ")));
    return *std::ranges::min_element(candidates, {}, [&](std::size_t i) { return preference(devices[i]); });
}

std::string whyDevice(const std::vector<DeviceFacts>& devices, const std::string& choice) {
    const DeviceFacts& chosen = devices[chooseDevice(devices, choice)];
    if (!choice.empty()) return fmt::format("asked for as \"{}\"", choice);
    const auto usable = std::ranges::count_if(devices, &DeviceFacts::usable);
    if (devices.size() == 1) return "the only one";
    if (usable == 1) return fmt::format("the only one of {} that has all that is needed", devices.size());
    return fmt::format("the first {} one of {} that have all that is needed", chosen.type, usable);
}

Device::Device(std::nullptr_t) : pipelines_(std::make_unique<PipelineCache>()), messages_(std::make_unique<Messages>()) {}

Device::Device(const DeviceOptions& options) : Device(nullptr) {
    const char* environment = std::getenv("LODESTIR_VALIDATION");
    validating_ = options.validation.value_or(environment && std::string_view(environment) == "1");
    if (validating_ && !hasLayer(validationLayer))
        throw Error(fmt::format("{} is not installed", validationLayer), "install the Vulkan validation layers, or run without validation");

    // The messenger also hears vkCreateInstance and vkDestroyInstance. Only the layer's own verdicts count: loaders
    // and drivers send "general" messages about other devices of the machine.
    const bool debugUtils = validating_ || hasInstanceExtension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    messages_->receive = [messages = messages_.get()](const char* text) {
        const std::lock_guard lock(messages->mutex);
        messages->texts.push_back(text);
        log::warn("validation: {}", text);
    };
    VkDebugUtilsMessengerCreateInfoEXT messenger{};
    messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = receive;
    messenger.pUserData = &messages_->receive;

    std::vector<const char*> extensions, layers;
    for (const std::string& extension : options.windowExtensions) extensions.push_back(extension.c_str());
    if (debugUtils) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (validating_) layers.push_back(validationLayer);
    instance_ = createInstance(extensions, layers, validating_ ? &messenger : nullptr);
    const std::vector<DeviceFacts> devices = instance_ ? describeAll(instance_) : std::vector<DeviceFacts>{};
    const std::size_t chosen = chooseDevice(devices, options.choice);
    reason_ = whyDevice(devices, options.choice);
    facts_ = devices[chosen];
    physical_ = physicalDevices(instance_)[chosen];
    queueFamily_ = static_cast<std::uint32_t>(findQueueFamily(physical_));
    if (validating_) {
        const auto create =
            reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
        check(create(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
    }

    FeatureChain chain;
    const std::vector<const char*> enabled = enableFeatures(physical_, !options.windowExtensions.empty(), chain);
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = queueFamily_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &chain.core;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<std::uint32_t>(enabled.size());
    info.ppEnabledExtensionNames = enabled.data();
    check(vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
    vkGetDeviceQueue(device_, queueFamily_, 0, &queue_);
    allocator_ = createAllocator(instance_, physical_, device_);
    if (facts_.readsTexels) {
        try {
            heap_ = std::make_unique<Heap>(*this);
        } catch (const Error& error) {  // a limit on address space, say: slower by address, but as right
            facts_.readsTexels = false;
            log::note("records are read by address: {}", error.what());
        }
    }

    if (debugUtils) {
        const auto load = [&](auto& function, const char* name) {
            function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(vkGetDeviceProcAddr(device_, name));
        };
        load(setName_, "vkSetDebugUtilsObjectNameEXT");
        load(beginLabel_, "vkCmdBeginDebugUtilsLabelEXT");
        load(endLabel_, "vkCmdEndDebugUtilsLabelEXT");
    }
}

Device::~Device() {
    if (device_) vkDeviceWaitIdle(device_);
    pipelines_.reset();
    heap_.reset();
    if (allocator_) vmaDestroyAllocator(allocator_);
    if (device_) vkDestroyDevice(device_, nullptr);
    if (messenger_) {
        const auto destroy =
            reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(instance_, messenger_, nullptr);
    }
    if (instance_) vkDestroyInstance(instance_, nullptr);
}

const std::vector<std::string>& Device::validationMessages() const { return messages_->texts; }

void Device::waitIdle() const {
    const auto lock = lockQueue();
    check(vkDeviceWaitIdle(device_), "vkDeviceWaitIdle");
}

void Device::setName(VkObjectType type, std::uint64_t handle, const std::string& name) const {
    if (!setName_) return;
    const VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT, nullptr, type, handle, name.c_str()};
    check(setName_(device_, &info), "vkSetDebugUtilsObjectNameEXT");
}

void Device::beginLabel(VkCommandBuffer commands, const std::string& name) const {
    if (!beginLabel_) return;
    const VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, nullptr, name.c_str(), {}};
    beginLabel_(commands, &label);
}

void Device::endLabel(VkCommandBuffer commands) const {
    if (endLabel_) endLabel_(commands);
}

}  // namespace lodestir::gpu
