// SPDX-License-Identifier: MIT
#include <framework/gpu/acceleration.h>

#include <framework/core/error.h>

namespace lodestir::gpu {
namespace {

template <class F> F load(const Device& device, const char* name) {
    const auto function = reinterpret_cast<F>(vkGetDeviceProcAddr(device.handle(), name));
    if (!function) throw Error(std::string("the device has no ") + name, "trace with --rays packet or --rays lane");
    return function;
}

VkAccelerationStructureBuildGeometryInfoKHR buildInfo(VkAccelerationStructureTypeKHR type, const VkAccelerationStructureGeometryKHR& geometry) {
    VkAccelerationStructureBuildGeometryInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR;
    info.type = type;
    info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
    info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
    info.geometryCount = 1;
    info.pGeometries = &geometry;
    return info;
}

VkAccelerationStructureGeometryKHR geometryOf(const TriangleGeometry& source) {
    VkAccelerationStructureGeometryKHR geometry{};
    geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
    geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
    geometry.flags = source.opaque ? VK_GEOMETRY_OPAQUE_BIT_KHR : VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR;
    VkAccelerationStructureGeometryTrianglesDataKHR& triangles = geometry.geometry.triangles;
    triangles.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR;
    triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
    triangles.vertexData.deviceAddress = source.positions;
    triangles.vertexStride = source.stride;
    triangles.maxVertex = source.vertices - 1;
    triangles.indexType = VK_INDEX_TYPE_UINT32;
    triangles.indexData.deviceAddress = source.indices;
    return geometry;
}

}  // namespace

AccelerationStructure::AccelerationStructure(const Device& device, VkAccelerationStructureTypeKHR type, const VkAccelerationStructureGeometryKHR& geometry,
                                             std::uint32_t count, const std::string& name)
    : device_(device), type_(type), geometry_(geometry), count_(count) {
    const auto sizesOf = load<PFN_vkGetAccelerationStructureBuildSizesKHR>(device, "vkGetAccelerationStructureBuildSizesKHR");
    const auto create = load<PFN_vkCreateAccelerationStructureKHR>(device, "vkCreateAccelerationStructureKHR");
    const auto addressOf = load<PFN_vkGetAccelerationStructureDeviceAddressKHR>(device, "vkGetAccelerationStructureDeviceAddressKHR");
    const VkAccelerationStructureBuildGeometryInfoKHR info = buildInfo(type_, geometry_);
    VkAccelerationStructureBuildSizesInfoKHR sizes{};
    sizes.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR;
    sizesOf(device.handle(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, &count_, &sizes);
    memory_ = Buffer(device, sizes.accelerationStructureSize, Memory::device, name);
    scratch_ = Buffer(device, sizes.buildScratchSize, Memory::device, name + " (scratch)");
    VkAccelerationStructureCreateInfoKHR what{};
    what.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR;
    what.buffer = memory_.handle();
    what.size = sizes.accelerationStructureSize;
    what.type = type;
    check(create(device.handle(), &what, nullptr, &structure_), "vkCreateAccelerationStructureKHR");
    VkAccelerationStructureDeviceAddressInfoKHR where{};
    where.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR;
    where.accelerationStructure = structure_;
    address_ = addressOf(device.handle(), &where);
    device.setName(VK_OBJECT_TYPE_ACCELERATION_STRUCTURE_KHR, reinterpret_cast<std::uint64_t>(structure_), name);
}

AccelerationStructure::~AccelerationStructure() {
    load<PFN_vkDestroyAccelerationStructureKHR>(device_, "vkDestroyAccelerationStructureKHR")(device_.handle(), structure_, nullptr);
}

void AccelerationStructure::build(Commands& commands) const {
    VkAccelerationStructureBuildGeometryInfoKHR info = buildInfo(type_, geometry_);
    info.dstAccelerationStructure = structure_;
    info.scratchData.deviceAddress = scratch_.address();
    const VkAccelerationStructureBuildRangeInfoKHR range{count_, 0, 0, 0}, *ranges = &range;
    load<PFN_vkCmdBuildAccelerationStructuresKHR>(device_, "vkCmdBuildAccelerationStructuresKHR")(commands.handle(), 1, &info, &ranges);
}

std::vector<std::unique_ptr<AccelerationStructure>> buildBottomLevels(const Device& device, std::span<const TriangleGeometry> geometries) {
    std::vector<std::unique_ptr<AccelerationStructure>> structures;
    for (const TriangleGeometry& g : geometries)
        structures.push_back(g.triangles == 0 ? nullptr
                                              : std::make_unique<AccelerationStructure>(device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR,
                                                                                        geometryOf(g), g.triangles, "bottom level"));
    runOnce(device, [&](Commands& commands) {
        for (const auto& structure : structures)
            if (structure) structure->build(commands);
    });
    return structures;
}

std::unique_ptr<AccelerationStructure> makeTopLevel(const Device& device, VkDeviceAddress instances, std::uint32_t count) {
    VkAccelerationStructureGeometryKHR geometry{};
    geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
    geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
    geometry.geometry.instances.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
    geometry.geometry.instances.data.deviceAddress = instances;
    return std::make_unique<AccelerationStructure>(device, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, geometry, count, "top level");
}

}  // namespace lodestir::gpu
