// SPDX-License-Identifier: MIT
// Which way rays go on a device, and what is said of it; made-up devices, no GPU needed.
#include <framework/core/error.h>
#include <framework/graph/ray_body.h>

#include <gtest/gtest.h>

namespace lodestir {
namespace {

gpu::DeviceFacts device(std::string type, bool isLavapipe, std::uint32_t subgroupSize, bool rayQuery) {
    gpu::DeviceFacts facts;
    facts.name = "made up";
    facts.type = std::move(type);
    facts.isLavapipe = isLavapipe;
    facts.subgroupSize = subgroupSize;
    facts.rayQuery = rayQuery;
    return facts;
}

std::string errorOf(const gpu::DeviceFacts& facts, const std::string& wish) {
    try {
        chooseRayBody(facts, wish);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(RayBody, FastestThatTheDeviceCanRun) {
    EXPECT_EQ(chooseRayBody(device("cpu", true, 8, true), ""), RayBody::packet);
    for (const std::uint32_t lanes : {4u, 16u, 32u}) EXPECT_EQ(chooseRayBody(device("cpu", true, lanes, true), ""), RayBody::lane);
    EXPECT_EQ(chooseRayBody(device("cpu", false, 8, true), ""), RayBody::lane);
    EXPECT_EQ(chooseRayBody(device("discrete", false, 32, true), ""), RayBody::rayQuery);
    EXPECT_EQ(chooseRayBody(device("discrete", false, 64, false), ""), RayBody::lane);
}

// Ray queries of a CPU are no hardware.
TEST(RayBody, SaysWhy) {
    EXPECT_EQ(whyRayBody(device("cpu", true, 8, true)),
              "packet: eight lanes of the CPU share one walk, several times faster here than the driver's ray query");
    EXPECT_EQ(whyRayBody(device("cpu", true, 4, true)), "lane: each lane walks our own hierarchy, several times faster here than the driver's ray query; "
                                                        "packets would need 8 lanes a subgroup, not 4");
    EXPECT_EQ(whyRayBody(device("cpu", false, 8, true)), "lane: each lane walks our own hierarchy, because ray queries of a CPU are slow");
    EXPECT_EQ(whyRayBody(device("discrete", false, 32, true)), "ray_query: the driver traces, on most GPUs in hardware");
    EXPECT_EQ(whyRayBody(device("discrete", false, 64, false)), "lane: the device has no ray query, so each lane walks our own hierarchy");
}

TEST(RayBody, WhatADeviceCannotRunIsRefused) {
    const gpu::DeviceFacts four = device("cpu", true, 4, true), plain = device("discrete", false, 64, false);
    EXPECT_EQ(errorOf(four, "packet"), "ray body \"packet\" needs lavapipe with subgroups of 8; this is made up with subgroups of 4; use --rays lane");
    EXPECT_EQ(errorOf(plain, "ray_query"), "ray body \"ray_query\" needs VK_KHR_ray_query, which made up lacks; use --rays lane");
    EXPECT_EQ(errorOf(four, "beam"), "no ray body \"beam\"; known: packet, lane, ray_query");
    EXPECT_EQ(errorOf(four, "packt"), "no ray body \"packt\"; did you mean \"packet\"?");
    EXPECT_EQ(chooseRayBody(four, "ray_query"), RayBody::rayQuery);
    EXPECT_EQ(chooseRayBody(four, "lane"), RayBody::lane);
}

}  // namespace
}  // namespace lodestir
