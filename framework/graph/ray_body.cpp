// SPDX-License-Identifier: MIT
#include <framework/graph/ray_body.h>

#include <framework/core/error.h>

#include <algorithm>
#include <array>

namespace lodestir {
namespace {

constexpr std::array<std::string_view, 3> rayBodies{"packet", "lane", "ray_query"};

bool canTracePackets(const gpu::DeviceFacts& device) { return device.isLavapipe && device.subgroupSize == 8; }

}  // namespace

std::string_view nameOf(RayBody body) { return rayBodies[std::size_t(body)]; }

RayBody chooseRayBody(const gpu::DeviceFacts& device, const std::string& wish) {
    if (wish.empty() && canTracePackets(device)) return RayBody::packet;
    if (wish.empty()) return device.rayQuery && device.type != "cpu" ? RayBody::rayQuery : RayBody::lane;
    const auto found = std::ranges::find(rayBodies, wish);
    if (found == rayBodies.end()) {
        const std::vector<std::string> names(rayBodies.begin(), rayBodies.end());
        throw Error("no ray body \"" + wish + "\"", didYouMean(wish, names));
    }
    const auto body = RayBody(found - rayBodies.begin());
    if (body == RayBody::packet && !canTracePackets(device))
        throw Error(
            "ray body \"packet\" needs lavapipe with subgroups of 8; this is " + device.name + " with subgroups of " + std::to_string(device.subgroupSize),
            "use --rays lane");
    if (body == RayBody::rayQuery && !device.rayQuery)
        throw Error("ray body \"ray_query\" needs VK_KHR_ray_query, which " + device.name + " lacks", "use --rays lane");
    return body;
}

std::string whyRayBody(const gpu::DeviceFacts& device) {
    switch (chooseRayBody(device, "")) {
        case RayBody::packet: return "packet: eight lanes of the CPU share one walk, several times faster here than the driver's ray query";
        case RayBody::rayQuery: return "ray_query: the driver traces, on most GPUs in hardware";
        case RayBody::lane: break;
    }
    const std::string walk = "each lane walks our own hierarchy";
    if (!device.rayQuery) return "lane: the device has no ray query, so " + walk;
    if (!device.isLavapipe) return "lane: " + walk + ", because ray queries of a CPU are slow";
    return "lane: " + walk + ", several times faster here than the driver's ray query; packets would need 8 lanes a subgroup, not " +
           std::to_string(device.subgroupSize);
}

}  // namespace lodestir
