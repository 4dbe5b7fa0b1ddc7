// SPDX-License-Identifier: MIT
// The driver's acceleration structures (VK_KHR_acceleration_structure), for ray queries. Only on devices with facts().rayQuery.
#pragma once
#include <framework/gpu/commands.h>

#include <memory>
#include <span>
#include <vector>

namespace lodestir::gpu {

/// Triangles in device memory: positions begin with three floats, a triangle is three 32-bit indices.
struct TriangleGeometry {
    VkDeviceAddress positions = 0, indices = 0;
    std::uint32_t vertices = 0, triangles = 0;
    std::uint32_t stride = 3 * sizeof(float);  ///< bytes from position to position
    bool opaque = true;  ///< false: queries stop at each triangle to ask
};

class LODESTIR_API AccelerationStructure {
public:
    /// Reserves memory for what is to be built of `geometry`, `count` triangles or instances of it. Error when memory is out.
    AccelerationStructure(const Device& device, VkAccelerationStructureTypeKHR type, const VkAccelerationStructureGeometryKHR& geometry,
                          std::uint32_t count, const std::string& name);
    ~AccelerationStructure();
    AccelerationStructure(const AccelerationStructure&) = delete;
    AccelerationStructure& operator=(const AccelerationStructure&) = delete;

    /// Records the build. Its input must be visible, and a barrier stand before its first use.
    void build(Commands& commands) const;
    VkDeviceAddress address() const { return address_; }
    std::size_t bytes() const { return memory_.size(); }

private:
    const Device& device_;
    VkAccelerationStructureTypeKHR type_;
    VkAccelerationStructureGeometryKHR geometry_;
    std::uint32_t count_;
    Buffer memory_, scratch_;
    VkAccelerationStructureKHR structure_ = VK_NULL_HANDLE;
    VkDeviceAddress address_ = 0;
};

/// Builds a structure of each geometry, null where it has no triangles; waits.
LODESTIR_API std::vector<std::unique_ptr<AccelerationStructure>> buildBottomLevels(const Device& device, std::span<const TriangleGeometry> geometries);
/// A structure over `count` VkAccelerationStructureInstanceKHR at `instances`, not built yet.
LODESTIR_API std::unique_ptr<AccelerationStructure> makeTopLevel(const Device& device, VkDeviceAddress instances, std::uint32_t count);

}  // namespace lodestir::gpu
