// SPDX-License-Identifier: MIT
// How rays are traced, and which way a device gets.
#pragma once
#include <framework/gpu/device.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace lodestir {

/// The bodies of trace(): see shaders/trace.
enum class RayBody : std::uint8_t { packet, lane, rayQuery };
LODESTIR_API std::string_view nameOf(RayBody body);
/// The body for a device: the one named by `wish` ("packet", "lane", "ray_query"), or where that is empty the fastest it can run. Error where
/// it cannot.
LODESTIR_API RayBody chooseRayBody(const gpu::DeviceFacts& device, const std::string& wish);
/// Why an empty wish chooses what it does, as the end of a sentence.
LODESTIR_API std::string whyRayBody(const gpu::DeviceFacts& device);

}  // namespace lodestir
