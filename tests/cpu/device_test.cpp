// SPDX-License-Identifier: MIT
// Which device a choice means, and what is said when none fits; made-up devices, no GPU needed.
#include <framework/core/error.h>
#include <framework/gpu/device.h>

#include <gtest/gtest.h>

namespace lodestir::gpu {
namespace {

DeviceFacts device(int index, std::string name, std::string type, bool usable = true) {
    DeviceFacts facts;
    facts.index = index;
    facts.name = std::move(name);
    facts.type = std::move(type);
    facts.features = {{"shaderInt64", true, usable, ""}, {"rayQuery", false, false, "software BVH"}};
    return facts;
}

std::string errorOf(const std::vector<DeviceFacts>& devices, const std::string& choice) {
    try {
        chooseDevice(devices, choice);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

const std::vector<DeviceFacts> machine{device(0, "llvmpipe (LLVM 15)", "cpu"), device(1, "Big GPU", "discrete", false),
                                       device(2, "Small GPU", "integrated"), device(3, "Middle GPU", "discrete"),
                                       device(4, "Other GPU", "discrete")};

TEST(Device, PrefersTheFirstUsableDiscreteOne) {
    EXPECT_EQ(chooseDevice(machine, ""), 3u);
    EXPECT_EQ(chooseDevice({machine[0], machine[2]}, ""), 1u);
    EXPECT_EQ(chooseDevice({machine[0], machine[1]}, ""), 0u);
}

TEST(Device, TakesAnIndexOrPartOfAName) {
    EXPECT_EQ(chooseDevice(machine, "0"), 0u);
    EXPECT_EQ(chooseDevice(machine, "LLVMPIPE"), 0u);
    EXPECT_EQ(chooseDevice(machine, "small"), 2u);
    EXPECT_EQ(chooseDevice(machine, "gpu"), 3u);  // of several, the one that is preferred
}

TEST(Device, SaysWhatEachDeviceLacks) {
    EXPECT_EQ(errorOf({}, ""), "no Vulkan device found; install a Vulkan 1.3 driver; without a GPU, Mesa's lavapipe (24.1 or newer) does");
    EXPECT_EQ(errorOf({machine[1]}, ""), "no device has all that is needed; devices: 1: Big GPU (lacks shaderInt64)");
    EXPECT_EQ(errorOf({machine[0], machine[1]}, "big"),
              "device \"big\" lacks something needed; devices: 0: llvmpipe (LLVM 15), 1: Big GPU (lacks shaderInt64)");
    EXPECT_EQ(errorOf({machine[0]}, "5"), "no device \"5\"; devices: 0: llvmpipe (LLVM 15)");
}

}  // namespace
}  // namespace lodestir::gpu
