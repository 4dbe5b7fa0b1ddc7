// SPDX-License-Identifier: MIT
// `lodestir devices --test` tells what works, whatever the driver does.
#include "program.h"

#include <framework/gpu/device.h>

namespace lodestir::test {
namespace {

class DevicesTest : public ProgramTest {
protected:
    /// On a driver that has this fault ("crash", "hang"); empty: the machine's own.
    Output devices(const std::string& fault, Arguments arguments) {
        Environment environment{{"LODESTIR_VALIDATION", "1"}};
        if (!fault.empty()) {
            write("driver.json", {{"file_format_version", "1.0.0"}, {"ICD", {{"library_path", BROKEN_DRIVER_LIBRARY}, {"api_version", "1.3.0"}}}});
            const std::string file = (folder / "driver.json").string();
            environment.insert(environment.end(), {{"VK_DRIVER_FILES", file}, {"VK_ICD_FILENAMES", file}, {"BROKEN_DRIVER", fault}});
        }
        arguments.insert(arguments.begin(), {LODESTIR_BINARY, "devices", "--test"});
        return runProcess(arguments, environment);
    }
};

TEST_F(DevicesTest, AGoodDevicePasses) {
    if (std::ranges::none_of(gpu::listDevices(), &gpu::DeviceFacts::usable)) GTEST_SKIP() << "no usable Vulkan device";
    const Output text = devices("", {});
    EXPECT_EQ(text.exitCode, 0) << text.out << text.err;
    EXPECT_TRUE(text.out.starts_with("trivial kernel: works, ")) << text.out;
    EXPECT_NE(text.out.find("\npath-traced frame: works, "), std::string::npos) << text.out;
    const Output output = devices("", {"--json", "--rays", "lane"});
    EXPECT_EQ(output.exitCode, 0) << output.out << output.err;
    const OrderedJson json = OrderedJson::parse(output.out);
    EXPECT_EQ(json["works"], true);
    ASSERT_EQ(json["tests"].size(), 2u);
    for (const OrderedJson& test : json["tests"]) {
        EXPECT_EQ(test["works"], true);
        EXPECT_GT(test["compileMs"].get<double>(), 0);
        EXPECT_GT(test["ms"].get<double>(), 0);
        EXPECT_NE(test["device"], "");
    }
}

// If this fails, the first thing that a user meets is a shell's "Segmentation fault".
TEST_F(DevicesTest, ACrashOfTheDriverIsTold) {
    const Output text = devices("crash", {});
    EXPECT_EQ(text.exitCode, 1) << text.signal;
    EXPECT_EQ(text.out,
              "trivial kernel: crashed (signal 11, Segmentation fault); update the Vulkan driver, choose another device with --device, or another driver "
              "with VK_DRIVER_FILES\npath-traced frame: not tried\n");
    const Output output = devices("crash", {"--json"});
    EXPECT_EQ(output.exitCode, 1);
    const OrderedJson json = OrderedJson::parse(output.out);
    EXPECT_EQ(json["works"], false);
    EXPECT_EQ(json["tests"][0]["problem"], "crashed (signal 11, Segmentation fault)");
    EXPECT_EQ(json["tests"][1]["problem"], "not tried");
}

TEST_F(DevicesTest, AHangIsEnded) {
    const Output text = devices("hang", {"--limit", "0.5"});
    EXPECT_EQ(text.exitCode, 1) << text.signal;
    EXPECT_TRUE(text.out.starts_with("trivial kernel: did not end within 0.5 s; ")) << text.out;
}

TEST_F(DevicesTest, NoDriverIsNoCrash) {
    const Output output = runProcess({LODESTIR_BINARY, "devices", "--test"}, {{"VK_DRIVER_FILES", "/none.json"}, {"VK_ICD_FILENAMES", "/none.json"}});
    EXPECT_EQ(output.exitCode, 1) << output.signal;
    EXPECT_TRUE(output.out.starts_with("trivial kernel: no Vulkan device found; install a Vulkan 1.3 driver")) << output.out;
}

TEST_F(DevicesTest, WrongUse) {
    for (const Arguments& arguments : {Arguments{"--limit", "0"}, Arguments{"--limit", "nan"}}) EXPECT_EQ(devices("", arguments).exitCode, 2) << arguments[1];
    EXPECT_EQ(lodestir({"devices", "--limit", "3"}).exitCode, 2);
}

}  // namespace
}  // namespace lodestir::test
