// SPDX-License-Identifier: MIT
// Acceleration structures of the driver over a scene, for its own ray query.
#pragma once
#include <bench/rays_scenes.h>
#include <framework/gpu/commands.h>

#include <optional>
#include <vector>

namespace lodestir::bench {

class QueryScene {
public:
    QueryScene(const gpu::Device& device, const RayScene& scene) : device_(device) {
        load(createStructure_, "vkCreateAccelerationStructureKHR");
        load(destroyStructure_, "vkDestroyAccelerationStructureKHR");
        load(buildStructures_, "vkCmdBuildAccelerationStructuresKHR");
        load(sizesOf_, "vkGetAccelerationStructureBuildSizesKHR");
        load(addressOf_, "vkGetAccelerationStructureDeviceAddressKHR");
        std::vector<VkDeviceAddress> meshes;
        for (const Triangles& mesh : scene.meshes) meshes.push_back(buildMesh(mesh));
        top_ = buildTop(scene, meshes);
    }
    ~QueryScene() {
        for (const VkAccelerationStructureKHR s : structures_) destroyStructure_(device_.handle(), s, nullptr);
    }
    QueryScene(const QueryScene&) = delete;
    QueryScene& operator=(const QueryScene&) = delete;

    VkDeviceAddress address() const { return top_; }

private:
    template <class F> void load(F& function, const char* name) { function = reinterpret_cast<F>(vkGetDeviceProcAddr(device_.handle(), name)); }
    VkDeviceAddress keep(gpu::Buffer buffer) { return buffers_.emplace_back(std::move(buffer)).address(); }

    VkDeviceAddress buildMesh(const Triangles& mesh) {
        VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
        geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
        geometry.flags = VK_GEOMETRY_OPAQUE_BIT_KHR;
        auto& t = geometry.geometry.triangles;
        t.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR;
        t.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
        t.vertexData.deviceAddress = keep(gpu::makeBuffer(device_, std::as_bytes(std::span(mesh.positions)), "positions"));
        t.vertexStride = sizeof(glm::vec3);
        t.maxVertex = std::uint32_t(mesh.positions.size() - 1);
        t.indexType = VK_INDEX_TYPE_UINT32;
        t.indexData.deviceAddress = keep(gpu::makeBuffer(device_, std::as_bytes(std::span(mesh.triangles)), "triangles"));
        return build(VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, geometry, std::uint32_t(mesh.triangles.size()));
    }
    VkDeviceAddress buildTop(const RayScene& scene, const std::vector<VkDeviceAddress>& meshes) {
        std::vector<VkAccelerationStructureInstanceKHR> instances;
        for (const Placed& placed : scene.instances) {
            VkAccelerationStructureInstanceKHR& i = instances.emplace_back();
            for (int row = 0; row < 3; ++row)
                for (int column = 0; column < 4; ++column) i.transform.matrix[row][column] = placed.toWorld[column][row];
            i.mask = 0xff;
            i.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
            i.accelerationStructureReference = meshes[placed.mesh];
        }
        VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
        geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
        geometry.geometry.instances.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
        geometry.geometry.instances.data.deviceAddress = keep(gpu::makeBuffer(device_, std::as_bytes(std::span(instances)), "instances"));
        return build(VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, geometry, std::uint32_t(instances.size()));
    }
    VkDeviceAddress build(VkAccelerationStructureTypeKHR type, const VkAccelerationStructureGeometryKHR& geometry, std::uint32_t count) {
        VkAccelerationStructureBuildGeometryInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
        info.type = type;
        info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
        info.geometryCount = 1;
        info.pGeometries = &geometry;
        VkAccelerationStructureBuildSizesInfoKHR sizes{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
        sizesOf_(device_.handle(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, &count, &sizes);
        keep(gpu::Buffer(device_, sizes.accelerationStructureSize, gpu::Memory::device, "acceleration structure"));

        VkAccelerationStructureCreateInfoKHR create{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR};
        create.buffer = buffers_.back().handle();
        create.size = sizes.accelerationStructureSize;
        create.type = type;
        gpu::check(createStructure_(device_.handle(), &create, nullptr, &info.dstAccelerationStructure), "vkCreateAccelerationStructureKHR");
        structures_.push_back(info.dstAccelerationStructure);
        const gpu::Buffer scratch(device_, sizes.buildScratchSize, gpu::Memory::device, "scratch");
        info.scratchData.deviceAddress = scratch.address();
        const VkAccelerationStructureBuildRangeInfoKHR range{count, 0, 0, 0}, *ranges = &range;
        gpu::runOnce(device_, [&](gpu::Commands& commands) { buildStructures_(commands.handle(), 1, &info, &ranges); });

        VkAccelerationStructureDeviceAddressInfoKHR address{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR};
        address.accelerationStructure = structures_.back();
        return addressOf_(device_.handle(), &address);
    }

    const gpu::Device& device_;
    std::vector<gpu::Buffer> buffers_;
    std::vector<VkAccelerationStructureKHR> structures_;
    VkDeviceAddress top_ = 0;
    PFN_vkCreateAccelerationStructureKHR createStructure_ = nullptr;
    PFN_vkDestroyAccelerationStructureKHR destroyStructure_ = nullptr;
    PFN_vkCmdBuildAccelerationStructuresKHR buildStructures_ = nullptr;
    PFN_vkGetAccelerationStructureBuildSizesKHR sizesOf_ = nullptr;
    PFN_vkGetAccelerationStructureDeviceAddressKHR addressOf_ = nullptr;
};

}  // namespace lodestir::bench
